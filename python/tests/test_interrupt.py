"""Ctrl-C ends every call that lasts, and leaves no object that is half changed and looks whole."""

import contextlib
import pathlib
import signal
import time
from collections.abc import Callable, Iterator
from types import FrameType

import numpy as np
import pytest

import placegraph as pg
from graph_samples import ring
from placegraph import synthetic, vision

# Some times what a call needs to see an interrupt, on a busy machine.
SOON_S = 20.0


@contextlib.contextmanager
def interrupted() -> Iterator[None]:
    """Sends one interrupt soon after the begin; the block must end by it, within a call."""

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    began = time.monotonic()
    signal.setitimer(signal.ITIMER_REAL, 0.03)
    try:
        with pytest.raises(KeyboardInterrupt):
            yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert time.monotonic() - began < SOON_S


def grid(side: int, noise: float = 0.3) -> pg.PoseGraph:
    """A grid of side x side poses in the plane, measured to their neighbours."""
    random = np.random.default_rng(0)
    ids = np.arange(side * side)
    poses = np.column_stack([ids % side, ids // side, 0 * ids]).astype(float)
    pairs = np.array([(i, i + 1) for i in ids if (i + 1) % side]
                     + [(i, i + side) for i in ids[:-side]])
    measured = poses[pairs[:, 1]] - poses[pairs[:, 0]]
    measured += random.normal(0, 0.05, measured.shape)
    information = np.tile(100 * np.eye(3), (len(pairs), 1, 1))
    start = poses + random.normal(0, noise, poses.shape)
    return pg.PoseGraph.from_arrays(ids, start, pairs, measured, information)


@pytest.fixture(scope="module")
def large() -> pg.PoseGraph:
    return grid(200)


@pytest.fixture(scope="module")
def solved() -> pg.PoseGraph:
    return grid(100, 0.0)


Call = Callable[[], object]


def certificate(graph: pg.PoseGraph) -> Call:
    """A call of which nearly all time is the certificate: the graph is at its minimum."""
    minimum = pg.optimize(graph).graph
    return lambda: pg.optimize(minimum, certify=True)


def joint_covariance(graph: pg.PoseGraph) -> Call:
    marginals = pg.PoseMarginals(graph)
    return lambda: marginals.joint_covariance(graph.ids[::20])


def ceres() -> pg.PoseGraphOptions:
    options = pg.PoseGraphOptions()
    options.engine = "ceres"
    return options


CALLS: dict[str, Callable[[pg.PoseGraph], Call]] = {
    "optimize": lambda g: lambda: pg.optimize(g),
    "optimize_with_ceres": lambda g: lambda: pg.optimize(g, options=ceres()),
    "optimize_landmarks": lambda g: lambda: pg.optimize(pg.LandmarkGraph(g)),
    "certificate": certificate,
    "marginal_covariances": lambda g: lambda: pg.marginal_covariances(g),
    "joint_covariance": joint_covariance,
    "incremental_from_graph": lambda g: lambda: pg.IncrementalOptimizer(graph=g).finish(),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_call_on_a_graph_ends_and_the_graph_is_as_before(name: str, large: pg.PoseGraph) -> None:
    before = large.poses.copy()
    call = CALLS[name](large)
    with interrupted():
        call()
    np.testing.assert_array_equal(large.poses, before)
    assert pg.optimize(ring(noise=0.01)).ok


def test_an_incremental_optimizer_refuses_after_an_interrupted_change(large: pg.PoseGraph) -> None:
    incremental = pg.IncrementalOptimizer()
    with interrupted():
        incremental.add(large)
    for use in (lambda: incremental.cost, lambda: incremental.poses, incremental.finish,
                lambda: incremental.add(ring())):
        with pytest.raises(pg.Error, match="interrupted call left it half changed"):
            use()


def test_an_interrupted_question_changes_nothing(solved: pg.PoseGraph) -> None:
    incremental = pg.IncrementalOptimizer(graph=solved)
    incremental.finish()
    before = incremental.poses
    with interrupted():
        incremental.covariance(solved.ids[::20])
    np.testing.assert_array_equal(incremental.poses, before)
    assert incremental.covariance([3]).shape == (3, 3)


def test_a_factor_graph_and_a_smoother_are_as_before() -> None:
    def slow(T: pg.SE3) -> list[float]:
        return [T.translation[0] - 1.0]

    smoother = pg.FixedLagSmoother(5.0)
    numbers = [smoother.add_variable(0.0, pg.SE3.exp([0.1 * i, 0, 0, 0, 0, 0]))
               for i in range(400)]
    for number in numbers:
        smoother.add_residual(slow, [number], sigma=0.1)
    with interrupted():
        while True:
            smoother.update()
    assert smoother.variables == tuple(numbers) and smoother.update().marginalized == ()
    with interrupted():
        while True:
            pg.optimize_factors(smoother.window())


def test_rendering_leaves_no_folder(tmp_path: pathlib.Path) -> None:
    with interrupted():
        synthetic.render("town-loop", tmp_path / "town", frames=2000, threads=2)
    assert not list(tmp_path.iterdir())


def test_a_run_ends(drive: pathlib.Path) -> None:
    with interrupted():
        pg.run(drive)


def test_slam_refuses_after_an_interrupted_call(drive: pathlib.Path) -> None:
    dataset = pg.open_dataset(drive)
    frames = list(dataset.frames(stop=12))
    events: list[pg.Event] = []

    def interrupt(event: pg.Event) -> None:
        events.append(event)
        if len(events) == 3:
            raise KeyboardInterrupt

    slam = pg.Slam(dataset.calibration(), on_event=interrupt)
    with pytest.raises(KeyboardInterrupt):
        for frame in frames:
            slam.add_frame(frame)
    for use in (slam.finish, slam.snapshot, lambda: slam.add_frame(frames[-1])):
        with pytest.raises(pg.ArgumentError, match="an earlier call threw"):
            use()


def test_a_population_search_of_vision_ends() -> None:
    image = np.random.default_rng(1).integers(0, 255, (480, 640), dtype=np.uint8)
    options = vision.AlignOptions()
    options.optimizer = "swarm"
    options.swarm.generations = 5000
    options.swarm.stagnation = 5000
    with interrupted():
        vision.align(image, image, [[100, 100], [500, 100], [500, 400], [100, 400]],
                     options=options)
