"""The cost of Python: pairs of `placegraph run` and `placegraph.run`, each a process of its own.

    python python/bench/run_cost.py PROGRAM SEQUENCE [--pairs 5]

PROGRAM is the program of the same build. Both write the map's file; the program writes its other
results, too. Prints the CPU time of both processes for each pair, and the medians.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile

IN_PYTHON = """
import sys
import placegraph as pg
result = pg.run(sys.argv[1], map_file=sys.argv[2])
result.trajectory().write(sys.argv[2] + ".tum")
"""

FRAMES_IN_PYTHON = """
import sys
import placegraph as pg
dataset = pg.open_dataset(sys.argv[1])
slam = pg.Slam(dataset.calibration())
for frame in dataset.frames():
    slam.add_frame(frame.image, frame.stamp_ns / 1e9, right=frame.right, depth=frame.depth)
slam.finish().trajectory().write(sys.argv[2] + ".tum")
"""


def cpu_s(command: list[str]) -> float:
    """CPU time of a process."""
    before = os.times()
    subprocess.run(command, check=True, capture_output=True)
    after = os.times()
    return (after.children_user + after.children_system
            - before.children_user - before.children_system)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("sequence")
    parser.add_argument("--pairs", type=int, default=5)
    given = parser.parse_args()
    columns: dict[str, list[float]] = {"program": [], "run": [], "add_frame": [], "import": []}
    for pair in range(given.pairs):
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out")
            python = [sys.executable, "-c"]
            commands = {
                "program": [given.program, "run", given.sequence, "--out", out, "--quiet"],
                "run": [*python, IN_PYTHON, given.sequence, os.path.join(folder, "map.db")],
                "add_frame": [*python, FRAMES_IN_PYTHON, given.sequence,
                              os.path.join(folder, "frames")],
                "import": [*python, "import placegraph"],
            }
            for name in commands if pair % 2 == 0 else reversed(list(commands)):
                columns[name].append(cpu_s(commands[name]))
        print("  ".join(f"{name} {times[-1]:.3f} s" for name, times in columns.items()), flush=True)
    medians = {name: statistics.median(times) for name, times in columns.items()}
    for name in ("run", "add_frame"):
        extra = [own / other - 1 for own, other in zip(columns[name], columns["program"])]
        print(f"{name}: {medians[name]:.3f} s against {medians['program']:.3f} s of the program: "
              f"{100 * statistics.median(extra):+.2f} % (pairs from {100 * min(extra):+.2f} to "
              f"{100 * max(extra):+.2f} %)")


if __name__ == "__main__":
    main()
