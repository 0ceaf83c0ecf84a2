"""Error against CPU time: `accuracy.py DIR` reads DIR/accuracy.csv and writes DIR/pareto.png.

One panel per metric that several options ran, one curve per option over its resolutions; a ring marks a run that no
other option beats in both error and time.
"""
import csv
from pathlib import Path

import matplotlib.pyplot as plt

import script

COLUMNS = 3


def read(path):
    """{metric: {option: [(cpu time, error), ...]}}, only finite errors above zero, only metrics of several options."""
    metrics = {}
    try:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                if row["error"] in ("failed", "") or float(row["error"]) <= 0:
                    continue
                point = float(row["cpu_time_s"]), float(row["error"])
                metrics.setdefault(row["case"], {}).setdefault(row["option"], []).append(point)
    except OSError as error:
        raise script.FileError(f"{path}: {error.strerror}") from error
    except (KeyError, ValueError) as error:
        raise script.FileError(f"{path}: not an accuracy.csv ({error})") from error
    return {name: options for name, options in metrics.items() if len(options) > 1}


def on_front(point, options):
    return not any(time < point[0] and error < point[1] for points in options.values() for time, error in points)


def draw(axes, name, options, style):
    for option, points in options.items():
        axes.loglog(*zip(*sorted(points)), marker="o", markersize=3, label=option, **style[option])
        front = [point for point in points if on_front(point, options)]
        if front:
            axes.loglog(*zip(*front), "o", markersize=8, fillstyle="none", color=style[option]["color"])
    axes.set(title=name, xlabel="CPU time [s]", ylabel="error [-]")


def main():
    parser = script.Parser(description=__doc__)
    parser.add_argument("directory")
    directory = Path(parser.parse_args().directory)
    metrics = read(directory / "accuracy.csv")
    if not metrics:
        print("accuracy.py: no metric was run with more than one option: nothing to draw")
        return
    names = list(dict.fromkeys(option for options in metrics.values() for option in options))
    colours, lines = script.RUN_COLOURS, ("-", "--", ":")
    style = {option: {"color": colours[n % len(colours)], "linestyle": lines[n // len(colours) % len(lines)]}
             for n, option in enumerate(names)}
    rows = -(-len(metrics) // COLUMNS)
    figure, panels = plt.subplots(rows, COLUMNS, figsize=(14, 3.6 * rows + 1), squeeze=False)
    for axes, (name, options) in zip(panels.flat, metrics.items()):
        draw(axes, name, options, style)
    for axes in panels.flat[len(metrics):]:
        axes.set_axis_off()
    handles = [plt.Line2D([], [], marker="o", markersize=3, label=option, **style[option]) for option in names]
    script.legend_below(figure, handles)
    script.save(figure, directory / "pareto.png")


script.run(main)
