"""What the two plot scripts share: command line, exit codes, the look of the pictures.

Exit codes are those of `nilas`: 0 done, 2 bad input or usage, 4 a file that cannot be read or written. Every error is
one line on stderr.
"""
import argparse
import os
import sys

try:
    import h5py  # noqa: F401  (used by run_directory; asked for here so that the message below covers it)
    import matplotlib
    import numpy  # noqa: F401
except ImportError as missing:
    print(f"{os.path.basename(sys.argv[0])}: {missing}; install the Debian packages python3-matplotlib python3-h5py",
          file=sys.stderr)
    sys.exit(2)

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of a backend without a display)

# Okabe and Ito's palette, which colour-blind readers can tell apart.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000")
COMPONENT_COLOURS = (GREEN, ORANGE, BLUE)  # x, y, z
RUN_COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, BLACK)

plt.rcParams.update({
    "savefig.dpi": 130, "figure.dpi": 130, "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.08, "figure.constrained_layout.h_pad": 0.06, "savefig.facecolor": "white",
    "font.size": 10, "axes.titlesize": 10.5, "figure.titlesize": 12,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True,
    "grid.color": "#dddddd", "grid.linewidth": 0.6, "legend.frameon": False, "lines.linewidth": 1.4})


class InputError(Exception):
    """A mistake of the user's: exit code 2."""


class FileError(Exception):
    """A file that cannot be read or written, or is not what it should be: exit code 4."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise InputError(f"{message} (see --help)")


def run(main):
    """Calls main() and leaves with its exit code."""
    try:
        main()
    except (InputError, FileError) as error:
        print(f"{os.path.basename(sys.argv[0])}: {error}", file=sys.stderr)
        sys.exit(2 if isinstance(error, InputError) else 4)


def make_directory(path):
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"{path}: cannot be made: {error.strerror}") from error
    return path


def legend_below(figure, handles):
    """One legend for the whole figure, under its panels."""
    figure.legend(handles=handles, loc="lower center", ncol=min(len(handles), 4))
    rows = -(-len(handles) // 4)
    bottom = 0.3 * rows / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))


def save(figure, path):
    """Writes a picture, prints its path and forgets it."""
    try:
        figure.savefig(path)
    except OSError as error:
        raise FileError(f"{path}: cannot be written: {error.strerror}") from error
    plt.close(figure)
    print(path)
