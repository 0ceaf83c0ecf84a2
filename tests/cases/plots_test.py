"""plot.py and compare.py on a synthetic run directory whose numbers are known beforehand."""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

PLOTS = Path(__file__).resolve().parents[2] / "cases" / "plots"
sys.path.insert(0, str(PLOTS))
from run_directory import Frames, RunDirectory, moving_average, rotation  # noqa: E402
from plot import INTACT, loaded_axis, stages, viewed_from  # noqa: E402

LENGTH, RADIUS, NOSE, CENTRE = 1.8, 0.15, 0.2, 0.93  # of the body; CENTRE: of mass, behind the tip
SPEED, TILT = 100.0, np.radians(30)                  # path and axis lean by TILT from the vertical towards -y
AXIS = np.array([0, -np.sin(TILT), np.cos(TILT)])
START = -0.22                                        # m, of the tip on its path; 0 is the middle of the sheet
THICKNESS, SPACING = 0.3, 0.02
END, WINDOW = 8e-3, 5e-4
DECELERATION, PITCH_RATE = 500.0, 2.0                # m/s2 along the path; rad/s about x at the end


def write_run(directory, frames=9, bodies=("hcc",), **changes):
    """A body driven through a sheet along a straight line: kinematics, fields and loads in closed form."""
    directory.mkdir(parents=True)
    write_summary(directory, bodies, changes)
    write_history(directory, bodies)
    write_result(directory, bodies, np.linspace(0, END, frames))
    return directory


def write_summary(directory, bodies, changes):
    own = {"motion": "free", "peak_force_N": 300e3, "peak_force_filtered_N": 200e3, "peak_force_time_s": 2e-3,
           "peak_force_components_N": [0.0, 100e3, -250e3], "impulse_N_s": [0.0, 300.0, -400.0],
           "final_position_m": [0.0, -0.1, 0.2], "final_velocity_m_s": [0.0, -48.0, 83.0],
           "attitude_change_deg": -0.5, "max_penetration_m": 1e-3}
    summary = {"scene": "hcc-oblique", "title": "free HCC through 0.3 m", "ice": "cai-2025", "spacing_m": SPACING,
               "force_window_s": WINDOW, "end_time_s": END, "stopped_by": "end time", "particles": 1000,
               "steps": 4000, "momentum_residual": 1e-14, "angular_momentum_residual": 2e-14,
               "energy_residual": 3e-3, "failed_fraction": 0.05, "calibrated": ["alpha to Table 4"]}
    summary.update(own if len(bodies) == 1 else {"bodies": {name: own for name in bodies}})
    summary.update(changes)
    (directory / "summary.json").write_text(json.dumps(summary))


def travel(time):
    return SPEED * time - DECELERATION * time**2 / 2


def write_history(directory, bodies):
    steps = np.tile([1e-5, 3e-5], 200)
    time = np.cumsum(steps)
    load = 1e5 * np.exp(-((time - 2e-3) / 1e-3) ** 2) * (time > 2e-4) * (1 + 0.4 * np.sin(4e4 * time))
    zero = np.zeros_like(time)
    speed, ramp = SPEED - DECELERATION * (time - time[0]), time / END
    own = {"force_x_N": zero, "force_y_N": 0.5 * load, "force_z_N": -load}
    own |= {f"moment_{a}_N_m": zero for a in "xyz"} | {f"impulse_{a}_N_s": zero for a in "xyz"}
    own |= {f"position_{a}_m": (travel(time) + START - CENTRE) * AXIS[k] for k, a in enumerate("xyz")}
    own |= {f"velocity_{a}_m_s": speed * AXIS[k] for k, a in enumerate("xyz")}
    own |= {f"axis_{a}": np.full_like(time, AXIS[k]) for k, a in enumerate("xyz")}
    own |= {"attitude_deg": 60 - 0.5 * ramp**2, "angular_velocity_x_rad_s": PITCH_RATE * ramp,
            "angular_velocity_y_rad_s": zero, "angular_velocity_z_rad_s": zero, "penetration_m": zero}
    columns = {"time_s": time, "step": np.arange(1, len(time) + 1), "dt_s": steps}
    for name in bodies:
        columns |= {(f"{name}.{key}" if len(bodies) > 1 else key): value for key, value in own.items()}
    columns |= {"kinetic_ice_J": zero, "failed_fraction": 0.05 * ramp}
    rows = np.column_stack(list(columns.values()))
    np.savetxt(directory / "history.csv", rows, fmt="%.17g", delimiter=",", header=",".join(columns), comments="")


def radius_at(depth):
    """Radius of the body at a depth behind its tip."""
    return RADIUS * np.sqrt(1 - (1 - np.clip(depth / NOSE, 0, 1)) ** 2) * (depth < LENGTH)


def body_surface():
    """Rings of boundary particles on the nose and the front of the side: position, normal, area in the body frame."""
    depth, angle = map(np.ravel, np.meshgrid(np.linspace(0.005, 0.6, 60), np.radians(np.arange(4.5, 364, 9))))
    r = radius_at(depth)
    radial = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    slope = np.clip(NOSE - depth, 0, None) / NOSE**2
    normal = radial * (r / RADIUS**2)[:, None] + slope[:, None] * [0, 0, 1]
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return radial * r[:, None] + np.column_stack([0 * r, 0 * r, CENTRE - depth]), normal, np.full(len(r), 1e-4)


def write_result(directory, bodies, times):
    ice = sheet()
    points, strain = zip(*(deformed(ice, time) for time in times))
    surface, normal, area = body_surface()
    depth = np.concatenate([[0], np.linspace(0.002, LENGTH - 1e-9, 300)])
    half = np.column_stack([0 * depth, radius_at(depth), CENTRE - depth])
    outline = np.concatenate([half, half[::-1] * [1, -1, 1], half[:1]])
    pulse = np.exp(-((times - 2e-3) / 1e-3) ** 2)
    loaded = np.outer(pulse, np.clip(normal @ [0, 0.4, 0.9], 0, None))[:, :, None]
    pose = [np.cos(TILT / 2), np.sin(TILT / 2), 0, 0]
    with h5py.File(directory / "result.h5", "w") as file:
        file["VTKHDF/NumberOfPoints"] = np.full(len(times), len(ice))
        file["VTKHDF/Steps/Values"] = times
        file["VTKHDF/Points"] = np.concatenate(points)
        file["VTKHDF/PointData/plastic_strain"] = np.concatenate(strain).astype("f4")
        file["VTKHDF/PointData/von_mises_Pa"] = 1e6 * np.concatenate(strain).astype("f4")
        for name in bodies:
            file[f"bodies/{name}/position"] = (travel(times) + START - CENTRE)[:, None] * AXIS
            file[f"bodies/{name}/orientation_wxyz"] = np.tile(pose, (len(times), 1))
            file[f"bodies/{name}/traction_Pa"] = -8e6 * loaded * AXIS
            file[f"bodies/{name}/boundary/position_body"] = surface
            file[f"bodies/{name}/boundary/normal_body"] = normal
            file[f"bodies/{name}/boundary/area_m2"] = area
            file[f"bodies/{name}/outline_body"] = outline


def sheet():
    lattice = [np.arange(-n + 0.5, n) * SPACING for n in (4, 40, 7.5)]
    return np.stack(np.meshgrid(*lattice, indexing="ij"), axis=-1).reshape(-1, 3)


def deformed(ice, time):
    """Ice pushed aside by the body, and a plastic strain that falls off from its path."""
    tip = (travel(time) + START) * AXIS
    depth = (tip - ice) @ AXIS
    off = (ice - tip) + depth[:, None] * AXIS
    r = np.linalg.norm(off, axis=1) + 1e-12
    body = radius_at(np.clip(depth, 0, None)) * (depth > 0)
    pushed = ice + off * ((np.sqrt(r**2 + body**2) - r) / r)[:, None]
    pushed += np.outer(0.6 * np.clip(depth, 0, None) * np.exp(-(r / 0.1)**2) * (ice[:, 2] > 0.05), [0, 0, 1])
    entered = np.clip(tip[2] / THICKNESS + 0.5, 0, 1)
    return ice + entered * (pushed - ice), entered * 1.5 * np.exp(-r / 0.07) * (depth > -0.1)


def call(script, *arguments, environment=None):
    return subprocess.run([sys.executable, str(PLOTS / script), *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **(environment or {})}, check=False)


class PlotsTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)

    def assert_picture(self, path):
        """Neither blank nor one colour: a visible part of the pixels is not background, in many shades."""
        pixels = matplotlib.image.imread(path)[..., :3].reshape(-1, 3)
        self.assertGreater(np.mean(np.any(pixels < 0.95, axis=1)), 0.01, path)
        self.assertGreater(len(np.unique(np.round(pixels * 16), axis=0)), 10, path)

    def assert_refused(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def table(self, out):
        with open(out / "comparison.csv", encoding="utf-8") as file:
            lines = [line for line in file if not line.startswith("#")]
        return {row["quantity"]: row for row in csv.DictReader(lines)}


class Reading(PlotsTest):
    def test_moving_average_of_a_rectangular_pulse_is_its_exact_overlap_with_the_window(self):
        rng = np.random.default_rng(1)
        step = rng.uniform(0.5e-5, 2e-5, 500)
        time = np.cumsum(step)
        first, last, window = 100, 219, 4e-4
        force = np.zeros((500, 3))
        force[first:last + 1] = [1.0, -2.0, 3.0]
        centre, mean = moving_average(time, step, force, window)
        begin, end = time[first] - step[first], time[last]
        overlap = np.clip(np.minimum(centre + window / 2, end) - np.maximum(centre - window / 2, begin), 0, None)
        np.testing.assert_allclose(mean, np.outer(overlap / window, [1.0, -2.0, 3.0]), atol=1e-12)

    def test_moving_average_is_zero_padded_before_the_first_row(self):
        time = np.array([1.0, 2.0])
        centre, mean = moving_average(time, np.array([1.0, 1.0]), np.full((2, 3), 6.0), 3.0)
        np.testing.assert_allclose(centre, [-0.5, 0.5])
        np.testing.assert_allclose(mean[:, 2], [2.0, 4.0])

    def test_rotation_of_a_quarter_turn_about_x_turns_y_into_z(self):
        turn = rotation([[np.sqrt(0.5), np.sqrt(0.5), 0, 0]])[0]
        np.testing.assert_allclose(turn @ [0, 1, 0], [0, 0, 1], atol=1e-15)

    def test_frames_are_read_in_order(self):
        run = RunDirectory(write_run(self.root / "run"))
        with Frames(run) as frames:
            for frame in (0, 4, 8):
                points, strain = deformed(sheet(), frame * END / 8)
                np.testing.assert_allclose(frames.points(frame), points, atol=1e-15)
                np.testing.assert_allclose(frames.field("plastic_strain", frame), strain, rtol=1e-6, atol=1e-30)


class Plot(PlotsTest):
    def test_writes_three_pictures_and_prints_their_paths(self):
        run = write_run(self.root / "run")
        result = call("plot.py", run)
        self.assertEqual(result.returncode, 0, result.stderr)
        expected = [run / "plots" / name for name in ("section.png", "history.png", "traction.png")]
        self.assertEqual(result.stdout.split(), list(map(str, expected)))
        for path in expected:
            self.assert_picture(path)

    def test_draws_every_body_of_a_run_with_two(self):
        run = write_run(self.root / "run", bodies=("left", "right"))
        result = call("plot.py", run, "--out", self.root / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(path.name for path in (self.root / "out").iterdir()),
                         ["history-left.png", "history-right.png", "section.png", "traction-left.png",
                          "traction-right.png"])

    def test_ice_without_plastic_strain_is_drawn(self):
        run = write_run(self.root / "run")
        with h5py.File(run / "result.h5", "r+") as file:
            file["VTKHDF/PointData/plastic_strain"][...] = 0
        self.assertEqual(call("plot.py", run).returncode, 0)
        pixels = np.round(255 * matplotlib.image.imread(run / "plots" / "section.png")[..., :3]).astype(int)
        intact = [int(INTACT[k:k + 2], 16) for k in (1, 3, 5)]
        self.assertGreater(np.mean(np.all(pixels == intact, axis=2)), 0.05)

    def test_stages_follow_the_tip_through_the_sheet(self):
        run = RunDirectory(write_run(self.root / "run", frames=81))
        with Frames(run) as frames:
            top = [frames.bodies[0].outline(frame)[:, 2].max() for frame in stages(run, frames)]
            before = [frames.bodies[0].outline(frame - 1)[:, 2].max() for frame in stages(run, frames)]
            self.assertEqual(list(stages(run, frames))[-1], 80)
        bottom = -THICKNESS / 2
        self.assertTrue(before[0] < bottom + THICKNESS / 3 <= top[0], (before, top))
        self.assertTrue(before[1] < THICKNESS / 2 <= top[1], (before, top))

    def test_loaded_face_is_the_nose_for_a_body_that_is_pushed_back(self):
        run = RunDirectory(write_run(self.root / "run"))
        with Frames(run) as frames:
            np.testing.assert_array_equal(loaded_axis(frames.bodies[0]), [0, 0, 1])
        right, up = viewed_from(np.array([0, 0, 1]))
        np.testing.assert_array_equal([right, up], [[1, 0, 0], [0, 1, 0]])


class Compare(PlotsTest):
    def compare(self, **changes):
        first = write_run(self.root / "free")
        second = write_run(self.root / "fixed", **changes)
        out = self.root / "out"
        result = call("compare.py", first, second, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result, out

    def test_difference_table_holds_values_and_differences(self):
        result, out = self.compare(motion="fixed-path", peak_force_filtered_N=250e3, attitude_change_deg=0.0,
                                   peak_force_components_N=[0.0, 110e3, -280e3], impulse_N_s=[0.0, 600.0, -800.0],
                                   steps=5000, final_position_m=[0.0, -0.1, 0.25])
        table = self.table(out)
        expected = {"peak force, filtered": (200, 250, 25), "peak force, raw": (300, 300, 0),
                    "peak force, y component": (100, 110, 10), "peak force, z component": (-250, -280, -30),
                    "time of peak force": (2, 2, 0), "impulse of the ice on the body": (500, 1000, 100),
                    "change of attitude angle": (-0.5, 0, 0.5), "final position, z": (200, 250, 50),
                    "final velocity, z": (83, 83, 0), "steps": (4000, 5000, 25), "particles": (1000, 1000, 0),
                    "residual of energy": (3e-3, 3e-3, 0)}
        for quantity, numbers in expected.items():
            row = table[quantity]
            written = [float(row[key]) for key in ("free", "fixed", "fixed - free")]
            np.testing.assert_allclose(written, numbers, rtol=1e-12, atol=1e-12, err_msg=quantity)
        self.assertEqual(table["peak force, filtered"]["difference_in"], "%")
        self.assertEqual(table["peak force, z component"]["difference_in"], "kN")
        self.assertIn((out / "comparison.md").read_text(encoding="utf-8"), result.stdout)
        self.assert_picture(out / "comparison.png")

    def test_rows_taken_from_the_history_are_those_of_the_closed_form_motion(self):
        _, out = self.compare()
        table = self.table(out)
        first_row = 1e-5
        self.assertAlmostEqual(float(table["loss of speed"]["free"]), DECELERATION * (END - first_row), places=9)
        self.assertAlmostEqual(float(table["largest angular velocity"]["free"]), PITCH_RATE, places=12)
        self.assertAlmostEqual(float(table["deflection from the straight path"]["free"]), 0, places=9)

    def test_like_with_like_carries_no_warning(self):
        result, out = self.compare()
        self.assertNotIn("not like with like", result.stdout)
        self.assertFalse((out / "comparison.csv").read_text(encoding="utf-8").startswith("#"))

    def test_each_condition_that_differs_is_named_in_the_header(self):
        result, out = self.compare(ice="real-ice", spacing_m=0.01, force_window_s=1e-3, end_time_s=4e-3)
        for words in ("cai-2025, real-ice", "0.02, 0.01", "0.0005, 0.001", "0.008, 0.004"):
            self.assertIn(words, result.stdout)
            self.assertIn(words, (out / "comparison.csv").read_text(encoding="utf-8"))


class Errors(PlotsTest):
    def test_missing_directory_is_bad_input(self):
        for script in ("plot.py", "compare.py"):
            self.assert_refused(call(script, self.root / "none"), 2, "none", "no such directory")

    def test_directory_without_summary_is_bad_input(self):
        for script in ("plot.py", "compare.py"):
            self.assert_refused(call(script, self.root), 2, "not a run directory")

    def test_no_argument_is_bad_usage(self):
        for script in ("plot.py", "compare.py"):
            self.assert_refused(call(script), 2, "required")

    def test_broken_files_are_named(self):
        for name, scripts in (("summary.json", ("plot.py", "compare.py")), ("history.csv", ("plot.py", "compare.py")),
                              ("result.h5", ("plot.py",))):
            run = write_run(self.root / f"broken-{name}")
            (run / name).write_bytes(b"time_s\n1,2,\x00garbage")
            for script in scripts:
                self.assert_refused(call(script, run, "--out", self.root / "out"), 4, name)

    def test_missing_result_is_named(self):
        run = write_run(self.root / "run")
        (run / "result.h5").unlink()
        self.assert_refused(call("plot.py", run), 4, "result.h5")

    def test_missing_summary_key_is_named(self):
        run = write_run(self.root / "run", peak_force_time_s=None)
        self.assert_refused(call("compare.py", run, "--out", self.root / "out"), 4, "summary.json", "peak_force_time_s")

    def test_output_that_cannot_be_made_is_named(self):
        run = write_run(self.root / "run")
        self.assert_refused(call("plot.py", run, "--out", run / "summary.json" / "out"), 4, "summary.json")

    def test_missing_python_module_names_the_debian_packages(self):
        (self.root / "h5py.py").write_text("raise ModuleNotFoundError(\"No module named 'h5py'\")")
        result = call("plot.py", self.root, environment={"PYTHONPATH": str(self.root)})
        self.assert_refused(result, 2, "python3-matplotlib python3-h5py")


if __name__ == "__main__":
    unittest.main()
