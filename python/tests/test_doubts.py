"""Every doubt that the program has is one of the package: both doors say the same words."""

import pathlib
import subprocess
import warnings
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from placegraph import _core, loops, maps

ODOMETRY = "EDGE_SE2 {} {} 1 0 0 100 0 0 100 0 400"


def chain(nodes: int, edges: Sequence[str] = ()) -> str:
    """A straight chain of poses with odometry, and edges."""
    lines = [f"VERTEX_SE2 {i} {i} 0 0" for i in range(nodes)]
    lines += [ODOMETRY.format(i, i + 1) for i in range(nodes - 1)]
    return "\n".join([*lines, *edges]) + "\n"


def noisy(factor: float) -> str:
    """Twelve poses with loops of 1 cm noise, and the information of that times `factor`."""
    random = np.random.default_rng(3)
    lines = [f"VERTEX_SE2 {i} {i} 0 0" for i in range(12)]
    for step in (1, 2, 3):
        for i in range(12 - step):
            x, y, angle = np.array([step, 0, 0]) + 0.01 * random.standard_normal(3)
            weight = 1e4 * factor
            lines.append(f"EDGE_SE2 {i} {i + step} {x:.9f} {y:.9f} {angle:.9f} "
                         f"{weight} 0 0 {weight} 0 {weight}")
    return "\n".join(lines) + "\n"


FREE = "EDGE_SE2 4 2 -2 0 0 0 0 0 0 0 100"
DANGLING = ["VERTEX_SE2 9 9 0 0", "EDGE_SE2 4 9 5 0 0 100 0 0 0 0 400"]
LOOPS_OF_NO_SCALE = ["EDGE_SE2 0 9 8 3 1 100 0 0 100 0 400", "EDGE_SE2 3 17 9 -4 2 100 0 0 100 0 400"]
TWO_PARTS = ("VERTEX_XY 7 1 1\nVERTEX_SE2 20 5 5 0\nVERTEX_SE2 21 6 5 0\n"
             "EDGE_SE2_XY 1 7 0 1 100 0 100\n" + ODOMETRY.format(20, 21) + "\n")
GRAPHS = {
    "chi2_above": (noisy(1e4), []),
    "chi2_below": (noisy(1e-4), []),
    "not_unique": (chain(5, DANGLING), []),
    "loops_not_judged": (chain(20, LOOPS_OF_NO_SCALE), ["--robust", "auto"]),
    "held_components": (chain(3) + TWO_PARTS, []),
    "graph_file": ("".join(f"{line} {17.5 + i}\n" if line.startswith("VERTEX") else line + "\n"
                           for i, line in enumerate(chain(3).splitlines())), []),
}


def of_graph(kind: str, folder: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    text, arguments = GRAPHS[kind]
    path = folder / "graph.g2o"
    path.write_text(text)
    robust = arguments[1] if arguments else None
    read = pg.LandmarkGraph.read if kind == "held_components" else pg.PoseGraph.read
    return (["graph", "optimize", str(path), "-o", str(folder / "out.g2o"), *arguments],
            lambda: pg.optimize(read(path), robust=robust))


def of_trajectories(folder: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    """An estimate whose axes are turned by 180 degrees."""
    for name, sign in (("truth.tum", 1), ("estimate.tum", -1)):
        rows = [f"{i} {4 * i} {40 * sign * np.sin(0.1 * i):.6f} 0 0 0 {sign * np.sin(a / 2):.9f} "
                f"{np.cos(a / 2):.9f}" for i in range(60) for a in [np.arctan(np.cos(0.1 * i))]]
        (folder / name).write_text("\n".join(rows) + "\n")
    truth, estimate = folder / "truth.tum", folder / "estimate.tum"
    return ["eval", str(truth), str(estimate)], lambda: pg.evaluate(truth, estimate)


def of_loops(folder: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    truth, predictions = folder / "truth.txt", folder / "predictions.txt"
    truth.write_text("50 0 40 10\n51 0 40 11 12\n")
    predictions.write_text("50 10 0.9\n60 10 0.8\n")
    return (["loops", "--predictions", str(predictions), "--truth", str(truth)],
            lambda: loops.score(predictions, truth))


def of_distances(folder: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    """Three candidates of each query, the smallest score first."""
    truth, predictions = folder / "truth.txt", folder / "predictions.txt"
    truth.write_text("".join(f"{q} {q}\n" for q in range(20)))
    predictions.write_text("".join(f"{q} {(q + k) % 20} 0.{k + 1}\n" for q in range(20)
                                   for k in range(3)))
    return (["loops", "--predictions", str(predictions), "--truth", str(truth), "--min-age", "0"],
            lambda: loops.score(predictions, truth, min_age=0))


def of_positions(folder: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    """True positions without headings, of a place that is visited twice."""
    truth, predictions = folder / "truth.txt", folder / "predictions.txt"
    truth.write_text("".join(f"{i} {i % 30} 0 0\n" for i in range(60)))
    predictions.write_text("".join(f"{q} {q - 30} 0.5\n" for q in range(30, 60)))
    options = loops.RevisitOptions()
    options.min_age = 20
    return (["loops", "--predictions", str(predictions), "--true-poses", str(truth), "--min-age", "20"],
            lambda: loops.score(predictions, loops.ImageSet.read(truth).poses, options=options))


def of_options(folder: pathlib.Path, drive: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    path = folder / "mine.yaml"
    path.write_text("odometry:\n  tracker:\n    min_sigma_px: 2\n")
    return (["config", "--config", str(path)],
            lambda: pg.RunOptions.from_yaml(path.read_text(), str(path)))


def of_recording(folder: pathlib.Path, drive: pathlib.Path) -> tuple[list[str], Callable[[], object]]:
    options = pg.RunOptions()
    options.camera_height_m, options.max_frames = 1.2, 10
    return (["run", str(drive), "--out", str(folder / "out"), "--set", "max_frames=10",
             "--set", "camera_height_m=1.2"], lambda: pg.run(drive, options))


@pytest.mark.filterwarnings("always")
@pytest.mark.parametrize("kind", _core.doubt_kinds)
def test_both_doors_say_the_same(
    kind: str, program: str, tmp_path: pathlib.Path, request: pytest.FixtureRequest
) -> None:
    if kind == "query_refused":  # the program's line: tests/unit/apps/map/queries/localize_test.cpp
        with pytest.warns(pg.Doubt, match="1 of 2 images are refused before the comparison"):
            seen: list[Any] = [SimpleNamespace(stage=stage) for stage in ("pose", "grey")]
            maps._warn_of_refusals(seen)
        return
    if kind in GRAPHS:
        arguments, call = of_graph(kind, tmp_path)
    else:
        makers = {"trajectories": of_trajectories, "not_judged": of_loops,
                  "score_order": of_distances, "headings": of_positions}
        with_drive = {"retired_option": of_options, "recording": of_recording}
        if kind in makers:
            arguments, call = makers[kind](tmp_path)
        else:
            arguments, call = with_drive[kind](tmp_path, request.getfixturevalue("drive"))
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    warned = [str(each.message) for each in caught if issubclass(each.category, pg.Doubt)]
    assert warned, f"no doubt of {kind}: {done.stderr}"
    for text in warned:
        assert text.split(": ", 1)[1] in done.stderr, (text, done.stderr)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(pg.Doubt):
            call()


@pytest.mark.parametrize("noise, silent", [(0, True), (1, True), (4, True), (1 / 4, True),
                                           (1e-2, False), (1e2, False)])
def test_chi2_within_a_tenth_and_ten_times_its_expectation_is_silent(
    noise: float, silent: bool
) -> None:
    graph = pg.PoseGraph()
    random = np.random.default_rng(5)
    for i in range(30):
        graph.add_node(i, [i, 0, 0])
    for step in (1, 2, 5):
        for i in range(30 - step):
            error = [0, 0, 0] if noise == 0 else 0.05 / noise**0.5 * random.standard_normal(3)
            graph.add_edge(i, i + step, np.array([step, 0, 0]) + error, 400 * np.eye(3))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = pg.optimize(graph)
    assert (len(caught) == 0) == silent == (result.doubts == ())


def test_without_a_result_there_is_an_exception() -> None:
    poses = np.stack([pg.SE3.exp([i, 0, 0, 0, 0, 0.1 * i]).matrix() for i in range(5)])
    drive = pg.Trajectory.from_arrays(np.arange(5) * 10**9, poses)
    late = pg.Trajectory.from_arrays(np.arange(5) * 10**9 + 10**15, poses)
    with pytest.raises(pg.NoResult):
        pg.evaluate(drive, late)
    with pytest.warns(pg.Doubt, match="b has no figures, so that there is no mean over all"):
        both = pg.compare(drive, {"a": drive, "b": late})
    with pytest.raises(pg.NoResult):
        both["b"]["ate_rmse_m"]
    with pytest.raises(pg.NoResult, match="no query has a true match"):
        loops.score(([5], [1], [0.5]), loops.LoopTruth({5: []}))
