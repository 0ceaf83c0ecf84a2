#!/usr/bin/env python3
"""Compares runs, the first being the reference: comparison.png, comparison.csv and comparison.md.

  compare.py runs/hcc-free runs/hcc-fixed-path runs/hcc-translation-only
  compare.py runs/hcc-free runs/hcc-fixed-path --out free-or-fixed
"""
import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import script
from script import RUN_COLOURS, plt

import numpy as np

from run_directory import RunDirectory

# What must be equal for differences to mean what the table says they mean.
CONDITIONS = ("ice", "spacing_m", "force_window_s", "end_time_s", "stopped_by")


def main():
    parser = script.Parser(description=__doc__, formatter_class=script.argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="+", metavar="DIRECTORY", help="run directory; the first is the reference")
    parser.add_argument("--out", type=Path, default=Path("comparison"), help="default: ./comparison")
    arguments = parser.parse_args()
    columns = read_columns(arguments.directories)
    table = make_table(columns)
    warnings = find_warnings(columns)
    out = script.make_directory(arguments.out)
    script.save(draw(columns, warnings), out / "comparison.png")
    write(out / "comparison.csv", lambda file: write_csv(file, columns, table, warnings))
    markdown = make_markdown(columns, table, warnings)
    write(out / "comparison.md", lambda file: file.write(markdown))
    print("\n" + markdown, end="")


@dataclass(frozen=True)
class Column:
    """One body of one run."""
    label: str
    run: RunDirectory
    body: str

    def number(self, key):
        return self.run.number(key, self.body)

    def vector(self, key):
        value = self.number(key)
        if np.shape(value) != (3,):
            raise script.FileError(f"{self.run.path / 'summary.json'}: '{key}' is not a vector: {value}")
        return value

    def condition(self, key):
        return self.run.get(key, body=self.body)


def read_columns(directories):
    paths = [Path(directory).resolve() for directory in directories]
    for k, path in enumerate(paths):
        if path in paths[:k]:
            raise script.InputError(f"{directories[k]}: given twice")
    columns = []
    for path, directory in zip(paths, directories):
        run = RunDirectory(directory)
        columns += [Column(f"{name_among(path, paths)} {body}".strip(), run, body) for body in run.bodies]
    if not columns:
        raise script.InputError(f"{directories[0]}: no body to compare")
    return columns


def name_among(path, paths):
    """The shortest end of the path that no other path has."""
    for length in range(1, len(path.parts) + 1):
        if sum(other.parts[-length:] == path.parts[-length:] for other in paths) == 1:
            return "/".join(path.parts[-length:])
    return str(path)


def find_warnings(columns):
    warnings = []
    for key in CONDITIONS:
        values = [column.condition(key) for column in columns]
        if any(value != values[0] for value in values):
            warnings.append(f"the runs differ in {key}: " + ", ".join(map(str, values)))
    return warnings


# ---- the difference table -------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Row:
    quantity: str
    unit: str
    relative: bool  # difference in percent of the first column, else in `unit`
    value: Callable  # of a Column, in `unit`


def rows():
    def entry(key, scale=1.0):  # a vector by its magnitude
        return lambda column: scale * float(np.linalg.norm(value) if np.ndim(value := column.number(key)) else value)

    def part(key, index, scale):
        return lambda column: scale * column.vector(key)[index]
    return [
        Row("peak force, filtered", "kN", True, entry("peak_force_filtered_N", 1e-3)),
        Row("peak force, raw", "kN", True, entry("peak_force_N", 1e-3)),
        *(Row(f"peak force, {axis} component", "kN", False, part("peak_force_components_N", k, 1e-3))
          for k, axis in enumerate("xyz")),
        Row("time of peak force", "ms", True, entry("peak_force_time_s", 1e3)),
        Row("impulse of the ice on the body", "N s", True, entry("impulse_N_s")),
        Row("loss of speed", "m/s", True, speed_loss_at_end),
        *(Row(f"final velocity, {axis}", "m/s", False, part("final_velocity_m_s", k, 1))
          for k, axis in enumerate("xyz")),
        Row("change of attitude angle", "°", False, entry("attitude_change_deg")),
        Row("largest angular velocity", "rad/s", False, largest_spin),
        *(Row(f"final position, {axis}", "mm", False, part("final_position_m", k, 1e3))
          for k, axis in enumerate("xyz")),
        Row("deflection from the straight path", "mm", False, final_deflection),
        Row("deepest penetration of a particle", "mm", False, entry("max_penetration_m", 1e3)),
        Row("failed fraction of the ice", "-", False, entry("failed_fraction")),
        Row("particles", "-", True, entry("particles")),
        Row("steps", "-", True, entry("steps")),
        Row("residual of momentum", "-", False, entry("momentum_residual")),
        Row("residual of angular momentum", "-", False, entry("angular_momentum_residual")),
        Row("residual of energy", "-", False, entry("energy_residual"))]


def make_table(columns):
    """[(row, values, differences)]; differences to the first column, None for it and where a percentage has no base."""
    table = []
    for row in rows():
        values = [row.value(column) for column in columns]
        differences = [None] + [difference(row, value, values[0]) for value in values[1:]]
        table.append((row, values, differences))
    return table


def difference(row, value, reference):
    if not row.relative:
        return value - reference
    return 100 * (value / reference - 1) if reference else None


def speed_loss(column):
    """Speed at the start less the speed, per row of the history [m/s]."""
    speed = np.linalg.norm(column.run.vector("velocity", "m_s", column.body), axis=1)
    return speed[0] - speed


def speed_loss_at_end(column):
    return float(speed_loss(column)[-1])


def largest_spin(column):
    spin = column.run.vector("angular_velocity", "rad_s", column.body)
    return float(np.linalg.norm(spin, axis=1).max())


def deflection(column):
    """Displacement across the initial velocity (all of it for a body that starts at rest), (rows, 3) [m]."""
    position = column.run.vector("position", "m", column.body)
    velocity = column.run.vector("velocity", "m_s", column.body)[0]
    travelled = position - position[0]
    speed = np.linalg.norm(velocity)
    direction = velocity / speed if speed else np.zeros(3)
    return travelled - np.outer(travelled @ direction, direction)


def final_deflection(column):
    return 1e3 * float(np.linalg.norm(deflection(column)[-1]))


# ---- files ----------------------------------------------------------------------------------------------------------

def write(path, writer):
    try:
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer(file)
    except OSError as error:
        raise script.FileError(f"{path}: cannot be written: {error.strerror}") from error
    print(path)


def write_csv(file, columns, table, warnings):
    """Full precision; warnings are comment lines ahead of the header."""
    file.writelines(f"# warning: {warning}\n" for warning in warnings)
    out = csv.writer(file, lineterminator="\n")
    first, *others = (column.label for column in columns)
    out.writerow(["quantity", "unit", "difference_in", first, *others, *(f"{name} - {first}" for name in others)])
    for row, values, differences in table:
        out.writerow([row.quantity, row.unit, "%" if row.relative else row.unit, *map(repr, map(float, values)),
                      *("" if d is None else repr(float(d)) for d in differences[1:])])


ROUND_OFF = 1e-9  # in the unit of the row: less than this is zero to a reader (the CSV has every digit)


def number_text(row, value):
    if float(value).is_integer() and abs(value) >= 1:
        return f"{value:.0f}"
    return f"{value:.2g}" if row.quantity.startswith("residual") else f"{value if abs(value) > ROUND_OFF else 0:.4g}"


def difference_text(row, change):
    if row.quantity.startswith("residual"):
        return ""
    return f"{change if abs(change) > ROUND_OFF else 0:+.3g}" + (" %" if row.relative else "")


def make_markdown(columns, table, warnings):
    first = columns[0].label
    lines = [f"# Comparison with {first}", ""]
    lines += [f"**Warning, not like with like: {warning}**\n" for warning in warnings]
    for column in columns:
        fitted = column.run.get("calibrated", [])
        lines.append(f"* {column.label}: {column.run.headline()}, motion {column.condition('motion')}"
                     + (f"; calibrated: {'; '.join(map(str, fitted))}" if fitted else ""))
    head = ["quantity", "unit", first]
    for column in columns[1:]:
        head += [column.label, "difference"]
    cells = [head]
    for row, values, differences in table:
        line = [row.quantity, row.unit, number_text(row, values[0])]
        for value, change in zip(values[1:], differences[1:]):
            line += [number_text(row, value), "" if change is None else difference_text(row, change)]
        cells.append(line)
    widths = [max(len(line[k]) for line in cells) for k in range(len(head))]
    aligned = ["| " + " | ".join(cell.ljust(w) if k < 2 else cell.rjust(w)
                                 for k, (cell, w) in enumerate(zip(line, widths))) + " |" for line in cells]
    rule = "|" + "|".join("-" * (w + 2) if k < 2 else "-" * (w + 1) + ":" for k, w in enumerate(widths)) + "|"
    return "\n".join([*lines, "", aligned[0], rule, *aligned[1:]]) + "\n"


# ---- the picture ----------------------------------------------------------------------------------------------------

def draw(columns, warnings):
    figure, axes = plt.subplots(2, 4, figsize=(17, 7.4))
    handles = []
    for k, column in enumerate(columns):
        style = {"color": RUN_COLOURS[k % len(RUN_COLOURS)], "linestyle": ("-", "--", "-.", ":")[k % 4]}
        handles.append(plt.Line2D([], [], label=f"{column.label} ({column.condition('motion')})", **style))
        draw_column(axes, column, style)
    for ax in axes.flat:
        ax.axhline(0, color="#888888", linewidth=0.6, zorder=0.5)
    for ax in (*axes[0], *axes[1, :2]):
        ax.set(xlabel="time [ms]")
        ax.set_xlim(left=0)
    ices = sorted({str(column.condition("ice")) for column in columns})
    scenes = list(dict.fromkeys(str(column.condition("scene")) for column in columns))
    title = f"{', '.join(scenes)} (ice: {', '.join(ices)})"
    figure.suptitle("\n".join([title, *(f"not like with like: {warning}" for warning in warnings)]))
    script.legend_below(figure, handles)
    return figure


def draw_column(axes, column, style):
    run, body = column.run, column.body
    time = 1e3 * run.time()
    centre, mean = run.filtered_force(body)
    position = run.vector("position", "m", body)
    attitude = run.column("attitude_deg", body)
    spin = run.column("angular_velocity_x_rad_s", body)
    across = deflection(column)
    curves = (("force magnitude, filtered [kN]", 1e3 * centre, 1e-3 * np.linalg.norm(mean, axis=1)),
              ("force along y, filtered [kN]", 1e3 * centre, 1e-3 * mean[:, 1]),
              ("force along z, filtered [kN]", 1e3 * centre, 1e-3 * mean[:, 2]),
              ("loss of speed [m/s]", time, speed_loss(column)),
              ("change of attitude angle [°]", time, attitude - attitude[0]),
              ("angular velocity about x [rad/s]", time, spin),
              ("y of the centre of mass [m]", position[:, 2], position[:, 1]),
              ("y off the straight path [mm]", position[:, 2],
               np.round(1e3 * across[:, 1], 6)))  # nothing below a nanometre: a straight path is a straight line
    for ax, (label, x, y) in zip(axes.flat, curves):
        ax.plot(x, y, **style)
        ax.set_ylabel(label)
    for ax in axes[1, 2:]:
        ax.set_xlabel("z of the centre of mass [m]")


if __name__ == "__main__":
    script.run(main)
