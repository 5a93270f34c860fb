"""Renders a drive, runs SLAM on it and evaluates the trajectory.

    python -m placegraph.examples.first_drive [FOLDER] [--frames N]
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence

import placegraph as pg


def first_drive(folder: str, frames: int) -> None:
    """Prints what the run says of itself, and its errors."""
    dataset = pg.synthetic.render("corridor-loop", folder, frames=frames, size=(320, 240))
    result = pg.run(dataset)
    print(result)
    if dataset.ground_truth is not None:
        print(pg.evaluate(dataset.ground_truth, result.trajectory()))


def main(arguments: Sequence[str] | None = None) -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("folder", nargs="?", help="folder for the sequence; none: a temporary one")
    parser.add_argument("--frames", type=int, default=300, help="number of frames (300)")
    given = parser.parse_args(arguments)
    if given.folder:
        first_drive(given.folder, given.frames)
        return
    with tempfile.TemporaryDirectory() as folder:
        first_drive(folder, given.frames)


if __name__ == "__main__":
    main()
