#!/usr/bin/env python3
"""Draws the outcome of every row of `nilas stability`: DIRECTORY/stability.png from DIRECTORY/stability.csv.

  stability.py stability
"""
import csv
from pathlib import Path

import script
from script import BLUE, GREEN, ORANGE, RED, plt

COLOURS = {"held": GREEN, "refused": BLUE, "stopped": ORANGE, "failed": RED}
COLUMNS = ["case", "value", "outcome", "energy_growth", "ledger_residual", "penetration_m", "message"]
ROW_HEIGHT = 0.19  # inches


def main():
    parser = script.Parser(description=__doc__, formatter_class=script.argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path, metavar="DIRECTORY", help="where stability.csv is")
    directory = parser.parse_args().directory
    rows = read(directory / "stability.csv")
    script.save(draw(rows), directory / "stability.png")


def read(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
    except OSError as error:
        raise script.FileError(f"{path}: cannot be read: {error.strerror}") from error
    if reader.fieldnames != COLUMNS:
        raise script.FileError(f"{path}: is no table of nilas stability")
    if not rows:
        raise script.FileError(f"{path}: holds no row")
    for row in rows:
        if row["outcome"] not in COLOURS:
            raise script.FileError(f"{path}: unknown outcome '{row['outcome']}'")
    return rows


def draw(rows):
    """A line per row: what was tried, a block in the colour of its outcome, its residual."""
    figure, (outcome, residual) = plt.subplots(
        1, 2, sharey=True, figsize=(10, 1.6 + ROW_HEIGHT * len(rows)), width_ratios=(1, 3))
    heights = range(len(rows))
    colours = [COLOURS[row["outcome"]] for row in rows]
    outcome.barh(heights, 1, height=0.9, color=colours)
    outcome.set(xticks=[], xlim=(0, 1), ylim=(len(rows) - 0.4, -0.6), title="outcome")
    outcome.set_yticks(heights, labels=[label(row, previous) for row, previous in zip(rows, [None, *rows])], fontsize=7)
    outcome.grid(False)
    for height, row in zip(heights, rows):
        outcome.text(0.5, height, row["outcome"], ha="center", va="center", fontsize=7, color="white")

    points = [(float(row["ledger_residual"]), height, colour)
              for height, row, colour in zip(heights, rows, colours) if row["ledger_residual"]]
    for value, height, colour in points:
        residual.plot(max(value, 1e-16), height, "o", markersize=4, color=colour)
    residual.axvline(0.05, color="#888888", linewidth=0.8)
    residual.set(xscale="log", xlim=(5e-17, 10), title="largest relative residual of the ledger, at most 0.05 to hold")
    residual.tick_params(axis="y", length=0)
    figure.suptitle(", ".join(f"{sum(row['outcome'] == word for row in rows)} {word}" for word in COLOURS))
    return figure


def label(row, previous):
    value = row["value"] if len(row["value"]) <= 60 else row["value"][:57] + "..."
    return f"{row['case']}: {value}" if previous is None or previous["case"] != row["case"] else value


if __name__ == "__main__":
    script.run(main)
