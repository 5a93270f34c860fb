"""What a notebook cell sends does not grow with the drive, and shows outliers and gaps."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import loops

MOST_BYTES = 300_000
SIZES = [100, 5_000, 100_000]
Array = NDArray[np.float64]


def street(count: int, seed: int = 1) -> Array:
    """Positions [m] of a drive through a town, 0.8 m apart, N x 3."""
    random = np.random.default_rng(seed)
    turns = np.zeros(count)
    for begin in np.flatnonzero(random.random(count) < 0.008):
        turns[begin:begin + 20] = random.choice([-1, 1]) * np.pi / 40
    heading = np.cumsum(turns)
    step = 0.8 * np.column_stack([np.cos(heading), np.zeros(count), np.sin(heading)])
    positions = np.cumsum(step, axis=0)
    positions[:, 1] = 3 * np.sin(np.arange(count) / 700)
    return positions


def trajectory(positions: Array, frames: NDArray[np.int64] | None = None) -> pg.Trajectory:
    numbers = np.arange(len(positions)) if frames is None else frames
    poses = np.tile(np.eye(4), (len(numbers), 1, 1))
    poses[:, :3, 3] = positions[numbers]
    return pg.Trajectory.from_arrays(numbers * 10**8, poses)


def estimated(positions: Array, seed: int) -> pg.Trajectory:
    """With noise, drift, an outlier 90 m off, and a gap."""
    count, random = len(positions), np.random.default_rng(seed)
    moved = positions + np.cumsum(random.normal(scale=0.01, size=positions.shape), axis=0)
    moved += random.normal(scale=0.2, size=positions.shape)
    moved[count * 3 // 8] += [60.0, 5, 60]
    frames = np.arange(count)
    lost = (frames >= count * 6 // 10) & (frames < count * 7 // 10)
    return trajectory(moved, frames[~lost])


def svg_of(html: str) -> ET.Element:
    """The picture in a text of HTML, which must be well formed."""
    return ET.fromstring(html[html.index("<svg"):html.index("</svg>") + 6])


@pytest.mark.parametrize("count", SIZES)
def test_evaluation(count: int) -> None:
    positions = street(count)
    result = pg.evaluate(trajectory(positions), estimated(positions, 2), name="mine")
    html = result._repr_html_()
    assert len(html.encode()) <= MOST_BYTES
    svg_of(html)
    for kind in ("xyz", "rpy", "rpe", "box", "violin"):
        assert len(result.picture(kind).to_svg().encode()) <= MOST_BYTES
    assert len(result.frames) == count, "data are not thinned"


def test_an_outlier_and_a_gap_are_drawn() -> None:
    positions = street(100_000)
    html = pg.evaluate(trajectory(positions), estimated(positions, 2))._repr_html_()
    curve = next(path for path in svg_of(html).iter("{http://www.w3.org/2000/svg}path")
                 if path.get("stroke") == "#0072b2")  # the error over the distance travelled
    at, x, y = [], 0, 0
    for letter, dx, dy in re.findall(r"([Ml])(-?\d+) ?(-?\d+)", curve.get("d", "")):
        x, y = (int(dx), int(dy)) if letter == "M" else (x + int(dx), y + int(dy))
        at.append((letter, x / 10, y / 10))
    xs, ys = np.array([p[1] for p in at]), np.array([p[2] for p in at])
    width = np.ptp(xs)
    assert (xs[np.argmin(ys)] - xs[0]) / width == pytest.approx(3 / 8, abs=0.01)
    assert np.sort(ys)[:8].min() < np.median(ys) - 100, "the outlier is far above the rest"
    breaks = [i for i in range(1, len(at)) if at[i][0] == "M" and xs[i] - xs[i - 1] > 0.05 * width]
    assert len(breaks) == 1
    assert (xs[breaks[0]] - xs[0]) / width == pytest.approx(0.7, abs=0.01)


@pytest.mark.parametrize("count", SIZES)
def test_comparison(count: int) -> None:
    positions = street(count)
    both = pg.compare(trajectory(positions),
                      {f"estimate {seed}": estimated(positions, seed) for seed in range(4)})
    assert len(both._repr_html_().encode()) <= MOST_BYTES


@pytest.mark.parametrize("count", SIZES)
def test_loop_score(count: int) -> None:
    random = np.random.default_rng(4)
    query = np.arange(50, 50 + count)
    candidate = np.where(random.random(count) < 0.7, query - 50, query - 40)
    score = random.random(count) + (candidate == query - 50)
    result = loops.score((query, candidate, score),
                         loops.LoopTruth({int(q): [int(q) - 50] for q in query}))
    html = result._repr_html_()
    assert len(html.encode()) <= MOST_BYTES
    svg_of(html)
    assert len(result.curve["recall"]) == count


@pytest.mark.parametrize("count", SIZES)
def test_pose_graph(count: int) -> None:
    """As many loops as poses, some of them refused: those are drawn."""
    from placegraph import _core

    positions, random = street(count), np.random.default_rng(3)
    poses = np.zeros((count, 7))
    poses[:, :3], poses[:, 6] = positions, 1
    chain = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    begin = random.integers(0, count - 2, count)
    near = np.column_stack([begin, np.minimum(begin + 2 + random.integers(0, 1 + count // 100),
                                              count - 1)])
    false = np.column_stack([np.arange(9), count - 1 - np.arange(9)])
    edges = np.concatenate([chain, near, false])
    steps = np.zeros((len(edges), 7))
    steps[:, :3], steps[:, 6] = positions[edges[:, 1]] - positions[edges[:, 0]], 1
    graph = pg.PoseGraph.from_arrays(
        np.arange(count), poses, edges, steps, np.tile(np.eye(6), (len(edges), 1, 1)),
        ["odometry"] * len(chain) + ["loop"] * (len(near) + len(false)))
    assert len(graph._repr_html_().encode()) <= MOST_BYTES  # type: ignore[attr-defined]
    rejected = list(range(len(edges) - len(false), len(edges)))
    svg = _core.pose_graph_picture(graph, None, rejected)
    assert len(svg.encode()) <= MOST_BYTES
    assert svg.count('stroke="#d55e00"') >= 2, "rejected loops have a legend and are drawn"
