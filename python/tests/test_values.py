"""Objects as values: pickle, copies, ==, hash and repr, and arrays that cannot be written to."""

import copy
import multiprocessing
import os
import pickle
import tempfile
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from placegraph import _core, graphs, loops
from checks import assert_read_only
from graph_samples import plane, ring

RANDOM = np.random.default_rng(11)


def drive(shift: float = 0.0, *, lost: int = -1) -> pg.Trajectory:
    poses = np.stack([pg.SE3.exp([i + shift * i * i, 0, 0, 0, 0, 0.1 * i]).matrix()
                      for i in range(8)])
    if lost >= 0:
        poses[lost] = np.nan
    return pg.Trajectory.from_arrays(np.arange(8) * 10**8, poses)


KITTI = tempfile.TemporaryDirectory()


def kitti(shift: float) -> pg.KittiEvaluation:
    """The judged submission of a short drive, always of the same name."""
    folders = [os.path.join(KITTI.name, name) for name in ("truth", "mine")]
    for folder, poses in zip(folders, (drive(), drive(shift))):
        os.makedirs(folder, exist_ok=True)
        poses.write(os.path.join(folder, "03.txt"), pg.TrajectoryFormat.KITTI)
    return pg.evaluate_kitti(*folders)


def failed_evaluation() -> pg.Evaluation:
    evaluation: pg.Evaluation = pg.compare(
        drive(), {"good": drive(), "none": pg.Trajectory()})["none"]
    return evaluation


def landmarks(seen: float = 1.0) -> pg.LandmarkGraph:
    """Poses in the plane, one of them measured, that see two points, the second one twice."""
    graph = pg.LandmarkGraph(plane())
    ids = graph.poses.ids
    graph.add_prior(ids[1], graph.poses.poses[1], 100 * np.eye(3))
    for point in (70, 71):
        graph.add_point(point, [1, 2])
        graph.add_observation(ids[0], point, [seen, 2], 4 * np.eye(2))
    graph.add_observation(ids[2], 71, [0.1, 0.2], np.eye(2))
    return graph


def mixed_graph(width: float = 1.3) -> pg.PoseGraph:
    graph = ring(8, noise=0.05)
    graph.add_edge(0, 5, graph.pose(3), np.eye(6), "other", pg.RobustKernel("huber", width))
    graph.add_position(2, [1, 2, 3], np.eye(3), [0.5, 0, 0.1])
    return graph


def calibration(baseline: float = 0.5) -> pg.Calibration:
    depth = pg.DepthCamera()
    depth.camera = pg.Camera(320, 240, 250, 250, 160, 120)
    depth.T_cam_depth = pg.SE3.exp([0.02, 0, 0, 0, 0.01, 0])
    return pg.Calibration(pg.Camera(640, 480, 500, 501, 320, 240), baseline, depth, 1.65)


def edges(scale: float = 1.0) -> pg.TruthNoise:
    return pg.TruthNoise.white(0.01 * scale, 0.001)


def truth_of(graph: pg.PoseGraph) -> dict[int, pg.SE3]:
    return {int(node): graph.pose(int(node)) for node in graph.ids}


def score(best: float = 0.9) -> loops.LoopScore:
    truth = loops.LoopTruth({125: [5], 126: []})
    return loops.score(([125, 125, 126], [60, 5, 61], [best, 0.8, 0.2]), truth)


CONSISTENCY = pg.edge_consistency(ring(12, noise=0.01), truth_of(ring(12)), edges())["odometry"]
OTHERS = pg.edge_consistency(ring(12, noise=0.02), truth_of(ring(12)), edges())["odometry"]

# Of every class two different values, made anew by each call.
VALUES: dict[str, tuple[Callable[[], Any], Callable[[], Any]]] = {
    "SE2": (lambda: pg.SE2(1, 2, 0.3), lambda: pg.SE2(1, 2, 0.4)),
    "SE3": (lambda: pg.SE3.exp([1, 2, 3, 0.1, 0.2, 0.3]), pg.SE3),
    "SO3": (lambda: pg.SO3.exp([0.1, 0.2, 0.3]), pg.SO3),
    "Sim3": (lambda: pg.Sim3.exp([1, 2, 3, 0.1, 0.2, 0.3, 0.4]), pg.Sim3),
    "Line3": (lambda: pg.Line3.from_direction([0, 1, 2], [1, 1, 0]),
              lambda: pg.Line3.from_direction([0, 1, 2], [1, 0, 0])),
    "Plane3": (lambda: pg.Plane3([1, 2, 3], 4), lambda: pg.Plane3([1, 2, 3], 5)),
    "Marker": (lambda: pg.Marker(pg.SE3.exp([1, 2, 3, 0, 0, 1]), 0.2),
               lambda: pg.Marker(pg.SE3(), 0.2)),
    "Camera": (lambda: pg.Camera(640, 480, 500, 501, 320, 240),
               lambda: pg.Camera(640, 480, 500, 501, 320, 240, pg.Distortion.EQUIDISTANT, [0.1])),
    "DepthCamera": (lambda: calibration().depth, pg.DepthCamera),
    "Calibration": (calibration, lambda: calibration(0.4)),
    "Trajectory": (lambda: drive(lost=3), drive),
    "StampedPose": (lambda: drive()[2], lambda: drive(lost=2)[2]),
    "RobustKernel": (lambda: pg.RobustKernel("huber", 1.3), lambda: pg.RobustKernel("huber", 1.4)),
    "PoseGraph": (mixed_graph, lambda: mixed_graph(1.2)),
    "PoseGraph in the plane": (plane, lambda: plane(4)),
    "LandmarkGraph": (landmarks, lambda: landmarks(1.5)),
    "OptimizedLandmarkGraph": (lambda: pg.optimize(landmarks()),
                               lambda: pg.optimize(landmarks(1.5))),
    "OptimizedGraph": (lambda: pg.optimize(plane(), certify=True), lambda: pg.optimize(plane())),
    "RejectedEdge": (lambda: rejected()[0], lambda: rejected()[1]),
    "Certificate": (lambda: pg.optimize(plane(), certify=True).certificate,
                    lambda: pg.optimize(plane(4), certify=True).certificate),
    "Evaluation": (lambda: pg.evaluate(drive(), drive(0.01)),
                   lambda: pg.evaluate(drive(), drive(0.02))),
    "Evaluation that failed": (lambda: failed_evaluation(),
                               lambda: pg.evaluate(drive(), drive())),
    "Comparison": (lambda: pg.compare(drive(), {"a": drive(0.01, lost=1)}),
                   lambda: pg.compare(drive(), {"b": drive(0.01, lost=1)})),
    "Statistics": (lambda: pg.evaluate(drive(), drive(0.01)).ape_m,
                   lambda: pg.evaluate(drive(), drive(0.02)).ape_m),
    "AlignmentResult": (lambda: pg.evaluate(drive(), drive(0.01)).alignment,
                        lambda: pg.evaluate(drive(), drive(0.02)).alignment),
    "KittiEvaluation": (lambda: kitti(0.01), lambda: kitti(0.02)),
    "LoopTruth": (lambda: loops.LoopTruth({5: [1, 2], 7: []}), lambda: loops.LoopTruth({5: [1]})),
    "LoopScore": (score, lambda: score(0.7)),
    "TruthNoise": (edges, lambda: edges(2.0)),
    "EdgeConsistency": (lambda: copy.copy(CONSISTENCY), lambda: OTHERS),
    "Nees": (lambda: copy.copy(CONSISTENCY.by_stated), lambda: OTHERS.by_stated),
    "AxisConsistency": (lambda: copy.copy(CONSISTENCY.axes[0]), lambda: OTHERS.axes[0]),
    "RunOptions": (pg.RunOptions, lambda: pg.RunOptions.from_yaml("threads: 1\n")),
    "a group of options": (lambda: pg.RunOptions().loops,
                           lambda: pg.RunOptions.from_yaml("loops: {enabled: false}\n").loops),
}
MUTABLE = {"DepthCamera", "Calibration", "PoseGraph", "PoseGraph in the plane", "OptimizedGraph",
           "LandmarkGraph", "OptimizedLandmarkGraph",
           "RunOptions", "a group of options"}
# Classes of these values are made by functions on data that no short test has.
ELSEWHERE = {"DirectionNoise", "TruthMount"}
def pickled(protocol: int) -> Callable[[Any], Any]:
    return lambda value: pickle.loads(pickle.dumps(value, protocol))


COPIES: dict[str, Callable[[Any], Any]] = {
    "copy": copy.copy, "deepcopy": copy.deepcopy,
    **{f"pickle {protocol}": pickled(protocol)
       for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)}}


def rejected() -> tuple[Any, ...]:
    return pg.optimize(ring(40, noise=0.01, false_loops=4), robust="auto").rejected


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES.keys())
@pytest.mark.parametrize("name", VALUES)
def test_copies_are_equal_and_others_are_not(name: str, copied: Callable[[Any], Any]) -> None:
    make, make_other = VALUES[name]
    value, other = make(), make_other()
    again = copied(value)
    assert again is not value and type(again) is type(value)
    assert again == value and not again != value and value == make()
    assert value != other and not value == other
    assert value != 3 and value != None and value != "x"  # noqa: E711
    assert repr(again) == repr(value) and " object at 0x" not in repr(value)
    if name in MUTABLE:
        with pytest.raises(TypeError, match="unhashable"):
            hash(value)
    else:
        assert hash(again) == hash(value)
        assert len({value, again, other}) == 2 and {value: 1}[again] == 1


def test_every_class_that_is_pickled_is_tested() -> None:
    pickled = {name for name, kind in vars(_core).items()
               if isinstance(kind, type) and "__setstate__" in vars(kind)}
    tested = {type(make()).__name__ for make, _ in VALUES.values()}
    assert pickled - tested == ELSEWHERE | {"EvaluationResult", "KittiBenchmark",
                                                    "LoopBenchmark"}


def moved_at_random(T: Any, dof: int) -> Any:
    for _ in range(int(RANDOM.integers(30))):
        T = (T * type(T).exp(3 * RANDOM.normal(size=dof))).inverse()
    return T


@pytest.mark.parametrize("trial", range(20))
def test_motions_come_back_to_the_bit(trial: int) -> None:
    for kind, dof in ((pg.SE2, 3), (pg.SE3, 6), (pg.SO3, 3), (pg.Sim3, 7)):
        T = moved_at_random(kind(), dof)
        again = pickle.loads(pickle.dumps(T))
        assert again.matrix().tobytes() == T.matrix().tobytes() and again == T
        moved = T.plus(1e-6 * RANDOM.normal(size=dof))
        assert moved != T and hash(moved) != hash(T)


def bytes_of(graph: pg.PoseGraph) -> list[bytes]:
    return [array.tobytes() for array in
            (graph.ids, graph.poses, graph.edges, graph.measurements, graph.information,
             graph.fixed, graph.position_nodes, graph.positions, graph.lever_arms,
             graph.position_information)]


@pytest.mark.parametrize("graph", [mixed_graph(), plane(), pg.PoseGraph()],
                         ids=["space", "plane", "empty"])
def test_graphs_come_back_to_the_bit(graph: pg.PoseGraph) -> None:
    again = pickle.loads(pickle.dumps(graph))
    assert bytes_of(again) == bytes_of(graph)
    assert again.sources == graph.sources and again.kernels == graph.kernels


def test_a_copy_of_a_graph_is_independent() -> None:
    graph = plane()
    for copied in COPIES.values():
        other = copied(graph)
        other.set_poses(other.poses + 1)
        assert other != graph and graph == plane()


def test_zeros_of_both_signs_are_equal_and_nan_is_equal_to_nan() -> None:
    plus, minus = pg.SE3(), pg.SE3.from_quaternion_xyzw([0, 0, 0, 1], [-0.0, 0, 0])
    assert plus == minus and hash(plus) == hash(minus) and len({plus, minus}) == 1
    assert drive(lost=2) == drive(lost=2) and drive(lost=2) != drive(lost=3)
    failed = failed_evaluation()
    assert not failed and failed == failed_evaluation()


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_a_graph_goes_to_a_worker_and_its_optimum_comes_back(method: str) -> None:
    graph = mixed_graph()
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert pool.apply(copy.copy, (graph,)) == graph
        solved = pool.apply(pg.optimize, (graph,))
    assert solved == pg.optimize(graph)
    assert bytes_of(solved.graph) == bytes_of(pg.optimize(graph).graph)


def test_poses_in_a_graph_of_networkx_are_copied() -> None:
    networkx = pytest.importorskip("networkx")
    made = networkx.MultiDiGraph()
    made.add_node(0, pose=pg.SE3.exp([1, 2, 3, 0, 0, 1]))
    assert copy.deepcopy(made).nodes[0] == made.nodes[0]


def restored(value: Any, state: object) -> Any:
    """An object of the class of the value with a state that pickle might have read."""
    kind: Any = type(value)
    made = kind.__new__(kind)
    made.__setstate__(state)
    return made


def test_pickles_of_another_version_are_refused_by_name() -> None:
    for name in ("SE3", "PoseGraph", "LoopTruth"):
        value = VALUES[name][0]()
        version, data = value.__getstate__()
        assert version == pg.__version__
        with pytest.raises(pg.ArgumentError, match=rf"placegraph 9\.8\.7 wrote this {name}, and "
                                                   rf"placegraph {pg.__version__} does not"):
            restored(value, ("9.8.7", data))
    rebuild, arguments = pg.RunOptions().__reduce__()
    assert rebuild(*arguments) == pg.RunOptions() and arguments[-1] == pg.__version__
    with pytest.raises(pg.ArgumentError, match=r"placegraph 9\.8\.7 wrote this RunOptions"):
        rebuild(*arguments[:-1], "9.8.7")


@pytest.mark.parametrize("name", ["SE3", "PoseGraph", "Trajectory", "LoopTruth", "Camera"])
def test_damaged_pickles_are_refused(name: str) -> None:
    value = VALUES[name][0]()
    version, data = value.__getstate__()
    for length in {0, 1, len(data) // 2, len(data) - 1}:
        with pytest.raises(pg.ArgumentError, match="pickle: it is damaged"):
            restored(value, (version, data[:length]))
    for state in ((version, data + b"x"), (version, "text"), (version,), None, 3):
        with pytest.raises(pg.ArgumentError, match="pickle"):
            restored(value, state)


@pytest.mark.parametrize("name", VALUES)
def test_arrays_of_properties_cannot_be_written_to(name: str) -> None:
    assert_read_only(VALUES[name][0]())


def test_arrays_of_methods_cannot_be_written_to() -> None:
    T, camera = pg.SE3.exp([1, 2, 3, 0.1, 0.2, 0.3]), pg.Camera(640, 480, 500, 500, 320, 240)
    graph = pg.optimize(ring(8)).graph
    arrays = [T.matrix(), T.log(), T.adjoint(), T.transform([[1, 2, 3]]), camera.K(),
              camera.project([[0, 0, 1]]), pg.SE2(1, 2, 3).matrix(), pg.Sim3().log(),
              pg.marginal_covariances(graph), pg.marginal_covariances(graph, [1, 2]),
              pg.PoseMarginals(graph).joint_covariance([1, 2]), score().curve["precision"],
              score()._core.query_table()["has_match"],
              pg.evaluate(drive(), drive(0.01)).frame_table()["truth"],
              graphs.IncrementalOptimizer(graph=mixed_graph()).poses]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
        changed = array.copy()
        changed[...] = 0


def test_what_is_assigned_to_an_element_is_not_lost() -> None:
    graph = mixed_graph()
    tuples: list[Any] = [graph.kernels, graph.sources, pg.evaluate(drive(), drive()).warnings,
                         pg.Camera(640, 480, 500, 500, 320, 240).coefficients]
    for given in tuples:
        with pytest.raises(TypeError, match="does not support item assignment"):
            given[0] = given
