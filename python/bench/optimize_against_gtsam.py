"""Cost and CPU of `optimize` and of gtsam from the same initial values, graph by graph.

    python optimize_against_gtsam.py FOLDER [--repeat 5]

FOLDER holds sphere2500.g2o, M3500.g2o, kitti_00.g2o and parking-garage.g2o. Every solver minimizes
the same sum of squares: logarithms on the right, the first node held. CPU is the least of the
repeats, which take turns; reading and conversion are not part of it.
"""

from __future__ import annotations

import argparse
import pathlib
import time
from collections.abc import Callable
from typing import Any

import gtsam

import placegraph as pg
from placegraph.gtsam import from_gtsam, to_gtsam

GRAPHS = ("sphere2500", "M3500", "kitti_00", "parking-garage")


def solvers(graph: pg.PoseGraph) -> dict[str, Callable[[], Any]]:
    """Functions that solve the graph; each returns the solved pose graph, or a way to it."""
    factors, values = to_gtsam(graph)
    from_file = pg.PoseGraphOptions()
    from_file.initialization = "file"
    with_gtsam = {
        "gtsam LM": lambda: gtsam.LevenbergMarquardtOptimizer(factors, values).optimize(),
        "gtsam GN": lambda: gtsam.GaussNewtonOptimizer(factors, values).optimize(),
    }
    return {
        "placegraph": lambda: pg.optimize(graph).graph,
        "placegraph, file's poses": lambda: pg.optimize(graph, options=from_file).graph,
        **{name: (lambda solve=solve: (factors, solve())) for name, solve in with_gtsam.items()},
    }


def cost_of(solution: Any) -> float:
    graph = solution if isinstance(solution, pg.PoseGraph) else from_gtsam(*solution)
    return graph.chi2()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=5)
    arguments = parser.parse_args()
    print(f"{'graph':15} {'chi2 at first':>15}  {'solver':26} {'chi2':>15} {'CPU [ms]':>9}")
    for name in GRAPHS:
        graph = pg.PoseGraph.read(str(arguments.folder / f"{name}.g2o"))
        calls = solvers(graph)
        least = dict.fromkeys(calls, float("inf"))
        cost: dict[str, float] = {}
        for _ in range(arguments.repeat):
            for solver, solve in calls.items():
                begin = time.process_time()
                try:
                    solution = solve()
                except RuntimeError as error:  # gtsam: an indefinite system
                    print(f"{name:15} {solver}: {str(error).splitlines()[0]}")
                    continue
                least[solver] = min(least[solver], time.process_time() - begin)
                cost[solver] = cost_of(solution)
        for solver in cost:
            print(f"{name:15} {graph.chi2():15.6f}  {solver:26} {cost[solver]:15.6f} "
                  f"{1e3 * least[solver]:9.1f}", flush=True)


if __name__ == "__main__":
    main()
