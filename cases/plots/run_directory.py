"""Reads a run directory: summary.json, history.csv, result.h5. SI units, world frame (z up) unless a name says _body.

A directory that is none is an InputError; a file in it that is missing, broken or incomplete is a FileError.
"""
import json
from pathlib import Path

import h5py
import numpy as np

from script import FileError, InputError


class RunDirectory:
    """One run. `bodies` holds the names of its bodies, [""] if there is only one: files leave that name out."""

    def __init__(self, path):
        self.path = Path(path)
        if not self.path.is_dir():
            raise InputError(f"{path}: no such directory")
        if not (self.path / "summary.json").is_file():
            raise InputError(f"{path}: not a run directory (no summary.json)")
        self.summary = self._read_summary()
        self.history = self._read_history()
        self.bodies = list(self.summary.get("bodies") or {})
        if len(self.bodies) < 2:
            self.bodies = [""] if "force_x_N" in self.history else []

    def headline(self):
        """One line naming scene and ice, for titles."""
        title = self.get("title", "")
        return f"{self.get('scene')}" + (f": {title}" if title else "") + f" (ice: {self.get('ice')})"

    def get(self, key, *default, body=""):
        """A summary entry: the body's own, else that of the run, else the default; missing without one is an error."""
        own = self.summary["bodies"].get(body, {}) if body else {}
        for entries in (own, self.summary):
            if entries.get(key) is not None:
                return entries[key]
        if default:
            return default[0]
        raise FileError(f"{self.path / 'summary.json'}: no key '{key}'" + (f" for body '{body}'" if body else ""))

    def number(self, key, body=""):
        """A summary entry as a number, or an array of numbers."""
        value = self.get(key, body=body)
        try:
            number = np.asarray(value, dtype=float)
        except (TypeError, ValueError) as error:
            raise FileError(f"{self.path / 'summary.json'}: '{key}' is not a number: {value}") from error
        return float(number) if number.ndim == 0 else number

    def column(self, name, body=""):
        name = f"{body}.{name}" if body else name
        if name not in self.history:
            raise FileError(f"{self.path / 'history.csv'}: no column '{name}'")
        return self.history[name]

    def vector(self, name, unit, body=""):
        """Columns <name>_x_<unit>, _y_, _z_ as an array (rows, 3)."""
        return np.column_stack([self.column(f"{name}_{axis}_{unit}", body) for axis in "xyz"])

    def time(self):
        return self.column("time_s")

    def force(self, body=""):
        """Force of the ice on the body [N], (rows, 3)."""
        return self.vector("force", "N", body)

    def filtered_force(self, body=""):
        return moving_average(self.time(), self.column("dt_s"), self.force(body), self.number("force_window_s"))

    def _read_summary(self):
        path = self.path / "summary.json"
        try:
            summary = json.loads(path.read_text())
        except (OSError, ValueError) as error:
            raise FileError(f"{path}: cannot be read: {one_line(error)}") from error
        if not isinstance(summary, dict) or not isinstance(summary.get("bodies", {}), dict):
            raise FileError(f"{path}: not a summary")
        return summary

    def _read_history(self):
        path = self.path / "history.csv"
        try:
            with open(path) as file:
                names = file.readline().strip().split(",")
                lines = [line for line in file if line.strip()]
            rows = np.loadtxt(lines, delimiter=",", ndmin=2) if lines else np.empty((0, 0))
        except (OSError, ValueError) as error:
            raise FileError(f"{path}: cannot be read: {one_line(error)}") from error
        if rows.shape[0] == 0:
            raise FileError(f"{path}: no rows")
        if rows.shape[1] != len(names):
            raise FileError(f"{path}: {len(names)} names in the header, {rows.shape[1]} values in a row")
        return dict(zip(names, rows.T))


def moving_average(time, step, force, window):
    """Moving average of a force over `window`: returns (centre of the window, mean vector), one per row.

    Row k's force is constant over the step that ends at t_k (over the whole interval since the previous row if steps
    were left out), zero before the first row. The mean is therefore a difference of the exactly integrated impulse,
    which is linear between rows: mean_k = (J(t_k) - J(t_k - window)) / window, belonging to the time t_k - window / 2.
    """
    interval = np.diff(time, prepend=time[0] - step[0])
    knots = np.concatenate([[time[0] - step[0]], time])
    impulse = np.concatenate([np.zeros((1, 3)), np.cumsum(force * interval[:, None], axis=0)])
    before = np.column_stack([np.interp(time - window, knots, impulse[:, axis]) for axis in range(3)])
    return time - window / 2, (impulse[1:] - before) / window


class Frames:
    """The frames of result.h5, read one at a time. Use in a `with` statement."""

    def __init__(self, run):
        self.path = run.path / "result.h5"
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise FileError(f"{self.path}: cannot be read: {one_line(error)}") from error
        self.times = np.atleast_1d(self.read("VTKHDF/Steps/Values"))
        self.particles = int(np.ravel(self.read("VTKHDF/NumberOfPoints"))[0])
        if len(self.times) == 0 or self.particles == 0:
            raise FileError(f"{self.path}: no frames")
        self.fields = list(self.file.get("VTKHDF/PointData") or {})
        self.bodies = [Body(self, name) for name in (self.file.get("bodies") or {})]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    def body(self, name):
        """The body of that name; "" is the only one."""
        for body in self.bodies:
            if name in ("", body.name):
                return body
        raise FileError(f"{self.path}: no body '{name}'")

    def points(self, frame):
        """Particle positions [m], (N, 3)."""
        return self._of_frame("VTKHDF/Points", frame)

    def field(self, name, frame):
        """A particle field, (N,) or (N, 3)."""
        return self._of_frame(f"VTKHDF/PointData/{name}", frame)

    def _of_frame(self, name, frame):
        values = self.read(name, slice(frame * self.particles, (frame + 1) * self.particles))
        if len(values) != self.particles:
            raise FileError(f"{self.path}: '{name}' ends before frame {frame}")
        return values

    def read(self, name, part=()):
        try:
            return self.file[name][part]
        except (KeyError, OSError, ValueError) as error:
            raise FileError(f"{self.path}: '{name}' cannot be read: {one_line(error)}") from error


class Body:
    """A body of result.h5, one row per frame. *_body: in its own frame, whose origin is the centre of mass."""

    def __init__(self, frames, name):
        def read(entry):
            return frames.read(f"bodies/{name}/{entry}")
        self.name = name
        self.position = read("position")
        self.rotation = rotation(read("orientation_wxyz"))  # (frames, 3, 3), from body to world
        self.traction = read("traction_Pa")                 # (frames, particles, 3), mean since the previous frame
        self.boundary_position_body = read("boundary/position_body")
        self.boundary_normal_body = read("boundary/normal_body")
        self.boundary_area = read("boundary/area_m2")
        self.outline_body = read("outline_body")

    def outline(self, frame):
        """The outline in its pose [m], world frame, (M, 3)."""
        return self.position[frame] + self.outline_body @ self.rotation[frame].T


def rotation(quaternion):
    """Rotation matrices (n, 3, 3) of unit quaternions (n, 4) in the order w, x, y, z."""
    w, x, y, z = np.asarray(quaternion, dtype=float).T
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def one_line(error):
    return " ".join(str(error.strerror if isinstance(error, OSError) and error.strerror else error).split())
