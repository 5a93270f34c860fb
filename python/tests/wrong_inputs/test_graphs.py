"""Wrong pose graphs, factors and smoothers: an exception that names the argument."""

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from checks import wrong
from graph_samples import plane, ring
from placegraph import graphs

UNIT = np.eye(6)


def arrays(**changed: Any) -> Callable[[], pg.PoseGraph]:
    """A graph of three poses with some arguments of from_arrays replaced."""
    arguments: dict[str, Any] = {
        "ids": [0, 1, 2], "poses": np.zeros((3, 3)), "edges": [[0, 1], [1, 2]],
        "measurements": np.zeros((2, 3)), "information": np.tile(np.eye(3), (2, 1, 1)), **changed}
    return lambda: pg.PoseGraph.from_arrays(**arguments)


def edge(from_: Any = 0, to: Any = 1, measurement: Any = None, information: Any = UNIT,
         *more: Any) -> Callable[[], None]:
    return lambda: ring().add_edge(from_, to, pg.SE3() if measurement is None else measurement,
                                   information, *more)


def checked(graph: pg.PoseGraph, add: Callable[[pg.PoseGraph], Any]) -> Callable[[], None]:
    def check() -> None:
        add(graph)
        graph.check()

    return check


def factors(residual: Any = lambda x: x, value: Any = 0.0, **more: Any) -> Callable[[], Any]:
    """Adds a factor written in Python and solves."""
    def solve() -> Any:
        graph = pg.FactorGraph()
        graph.add_residual(residual, [graph.add_variable(value)], **more)
        return pg.optimize_factors(graph)

    return solve


def later(first: Any, then: Any) -> Callable[[float], Any]:
    """A residual that is right when it is added, and wrong in the solver."""
    calls = 0

    def residual(x: float) -> Any:
        nonlocal calls
        calls += 1
        return first if calls == 1 else then

    return residual


def only_an_edge() -> pg.PoseGraph:
    graph = pg.PoseGraph()
    graph.add_edge(0, 1, pg.SE3(), np.eye(6))
    return graph


def smoother() -> pg.FixedLagSmoother:
    made = pg.FixedLagSmoother(1.0)
    made.add_variable(0, 0.0)
    return made


def with_terms() -> pg.FactorGraph:
    graph = pg.FactorGraph()
    graph.add_variable(pg.SE3())
    graph.add_variable(0.0, held=True)
    graph.add(pg.Factor.pose_prior(pg.SE3(), sigma=1.0), [0])
    return graph


CASES: list[tuple[str, Callable[[], Any], type[Exception], str]] = [
    # arrays of a pose graph
    ("ids of floats", arrays(ids=[0.5, 1, 2]), ValueError, "ids"),
    ("fewer ids than poses", arrays(ids=[0, 1]), ValueError, "poses"),
    ("ids that repeat", arrays(ids=[0, 1, 1]), ValueError, "1"),
    ("poses of four numbers", arrays(poses=np.zeros((3, 4))), ValueError,
     "N x 3 (SE(2)), N x 7 (SE(3)) or N x 8 (Sim(3)), or matrices, N x 3 x 3 or N x 4 x 4, is needed"),
    ("poses of 2 x 2", arrays(poses=np.zeros((3, 2, 2))), ValueError, "N x 3 x 3 or N x 4 x 4"),
    ("matrices of zeros", arrays(poses=np.zeros((3, 4, 4))), ValueError, "poses: row 0"),
    ("matrices that are no rotations", arrays(poses=np.tile(np.diag([2.0, 1, 1, 1]), (3, 1, 1))),
     ValueError, "poses: row 0: rotation"),
    ("reflections of the plane", arrays(poses=np.tile(np.diag([-1.0, 1, 1]), (3, 1, 1))),
     ValueError, "poses: row 0: rotation"),
    ("keys beyond 2^63", arrays(ids=np.array([0, 1, 2**63], np.uint64)), ValueError,
     "ids: a value is not below 2^63"),
    ("an edge to a key beyond 2^63", arrays(edges=np.array([[0, 1], [1, 2**64 - 1]], np.uint64)),
     ValueError, "edges"),
    ("one information of another size", arrays(information=np.eye(6)), ValueError,
     "2 x 3 x 3, or one for all, 3 x 3, is needed"),
    ("one information that is not symmetric", arrays(information=np.triu(np.ones((3, 3)))),
     ValueError, "information"),
    ("fewer matrices than edges", arrays(measurements=np.eye(3)[None]), ValueError,
     "or matrices, 2 x 3 x 3"),
    ("poses with NaN", arrays(poses=np.full((3, 3), np.nan)), ValueError, "poses"),
    ("poses that are None", arrays(poses=None), TypeError, "poses"),
    ("poses of complex numbers", arrays(poses=np.zeros((3, 3), complex)), ValueError, "poses"),
    ("quaternions of zeros", arrays(poses=np.zeros((3, 7))), ValueError, "poses: row 0"),
    ("edges of three ids", arrays(edges=[[0, 1, 2]]), ValueError, "edges"),
    ("an edge to nowhere", arrays(edges=[[0, 1], [1, 9]]), ValueError, "9"),
    ("an edge to itself", arrays(edges=[[0, 1], [1, 1]]), ValueError, "1"),
    ("fewer measurements than edges", arrays(measurements=np.zeros((1, 3))), ValueError,
     "measurements"),
    ("measurements of another kind", arrays(measurements=np.zeros((2, 7))), ValueError,
     "measurements"),
    ("information of another size", arrays(information=np.zeros((2, 6, 6))), ValueError,
     "information"),
    ("information of zeros", arrays(information=np.zeros((2, 3, 3))), ValueError, "information"),
    ("indefinite information", arrays(information=np.tile(np.diag([1.0, -1, 1]), (2, 1, 1))),
     ValueError, "information"),
    ("too few sources", arrays(sources=["odometry"]), ValueError, "sources"),
    ("an unknown source", arrays(sources=["odometry", "guess"]), ValueError, "guess"),
    ("a fixed node that is absent", arrays(fixed=[7]), ValueError, "fixed"),
    # building and reading one
    ("a pose of five numbers", lambda: ring().add_node(99, [1, 2, 3, 4, 5]), ValueError, "pose"),
    ("a matrix of 3 x 4", lambda: ring().add_node(99, np.eye(4)[:3]), ValueError,
     "or a matrix, 3 x 3 or 4 x 4"),
    ("a matrix with another last row", lambda: ring().add_node(99, np.ones((4, 4))), ValueError,
     "pose: the last row"),
    ("poses of another kind", lambda: ring().set_poses(np.zeros((12, 3))), ValueError, "poses"),
    ("matrices of another kind", lambda: ring().set_poses(np.tile(np.eye(3), (12, 1, 1))),
     ValueError, "poses"),
    ("a pose of text", lambda: ring().add_node(99, "here"), ValueError, "pose"),
    ("an id of text", lambda: ring().add_node("a", pg.SE3()), TypeError, "id"),  # type: ignore[arg-type]
    ("information that is not symmetric", edge(information=np.triu(np.ones((6, 6)))), ValueError,
     "information"),
    ("information of a plane", edge(information=np.eye(3)), ValueError, "information"),
    ("a source that is unknown", edge(0, 1, None, UNIT, "guess"), ValueError, "source"),
    ("a kernel of text", edge(0, 1, None, UNIT, "loop", "huber"), TypeError, ""),
    ("an edge of another kind", lambda: ring().add_edge(0, 1, pg.SE2(), np.eye(3)), ValueError,
     "measurement"),
    ("a node of another kind", lambda: ring().add_node(99, pg.SE2()), ValueError, "pose"),
    ("a node of another kind than the edges", lambda: only_an_edge().add_node(0, pg.SE2()),
     ValueError, "pose"),
    ("a constraint of 2 ** 32", lambda: pg.IncrementalOptimizer(graph=ring()).reweight(
        [2**32], [0.0]), ValueError, "constraints"),
    ("the covariance of nothing", lambda: smoother().covariance([]), ValueError, "variable"),
    ("a motion that is not finite", lambda: pg.SE3.exp([1e308] * 6), ValueError, "xi"),
    ("a position of two numbers", lambda: ring().add_position(0, [1, 2], np.eye(3)), ValueError,
     "position"),
    ("a lever arm with infinity", lambda: ring().add_position(0, [1, 2, 3], np.eye(3),
                                                              [np.inf, 0, 0]),
     ValueError, "lever_arm"),
    ("a position of no node", checked(ring(), lambda g: g.add_position(99, [1, 2, 3], np.eye(3))),
     ValueError, "99"),
    ("poses of too few rows", lambda: ring().set_poses(np.zeros((3, 7))), ValueError, "poses"),
    ("a node that is absent", lambda: ring().pose(99), ValueError, "99"),
    ("a constraint that is absent", lambda: ring().without([999]), ValueError, "constraints"),
    ("an unknown rotation error", lambda: ring().chi2("angle"), ValueError, "rotation_error"),
    ("a file that is absent", lambda: pg.PoseGraph.read("/nowhere.g2o"), OSError, "nowhere"),
    ("a folder that is absent", lambda: ring().write_g2o("/nowhere/out.g2o"), OSError, "nowhere"),
    ("an unknown kernel", lambda: pg.RobustKernel("soft", 1), ValueError, "kind"),
    ("a kernel of no width", lambda: pg.RobustKernel("huber", 0), ValueError, "width"),
    ("no graph of networkx", lambda: pg.from_networkx(wrong(None)), ValueError, "graph"),
    ("no pose graph for networkx", lambda: pg.to_networkx(wrong(3)), ValueError, "graph"),
    ("no pose graph for gtsam", lambda: pg.gtsam.to_gtsam(wrong(3)), ValueError, "graph"),
    ("edges without a direction", lambda: pg.from_networkx(unposed().to_undirected()), ValueError,
     "direction"),
    ("nodes of text", lambda: pg.from_networkx(named()), ValueError, "graph: nodes"),
    ("optimization with options of text", lambda: pg.optimize(ring(), options=wrong("x")),
     ValueError, "options: PoseGraphOptions"),
    ("incremental options of another kind",
     lambda: pg.IncrementalOptimizer(wrong(pg.PoseGraphOptions())), ValueError, "options"),
    ("smoother with empty options", lambda: pg.FixedLagSmoother(1.0, wrong({})), ValueError,
     "options"),
    ("factor graph with empty options",
     lambda: pg.optimize_factors(pg.FactorGraph(), wrong({})), ValueError, "options"),
    ("a graph of networkx without poses", lambda: graphs.from_networkx(unposed()), ValueError,
     "pose"),
    # optimizing one
    ("an unknown method", lambda: pg.optimize(ring(), robust="magic"), ValueError, "robust"),
    ("options of another kind", lambda: pg.optimize(ring(), options=pg.RunOptions()),  # type: ignore[call-overload]
     ValueError, "options"),
    ("an array in place of a graph", lambda: pg.optimize(np.eye(3)), TypeError, ""),  # type: ignore[call-overload]
    ("covariance of no node", lambda: pg.marginal_covariances(ring(), [99]), ValueError, "99"),
    ("covariance of half a node", lambda: pg.PoseMarginals(ring()).joint_covariance([0.5]),
     ValueError, "ids"),
    ("weights of another number", lambda: pg.IncrementalOptimizer(graph=ring()).reweight([0], [1, 2]),
     ValueError, "weights"),
    ("a negative weight", lambda: pg.IncrementalOptimizer(graph=ring()).reweight([0], [-1]),
     ValueError, "weight"),
    ("a constraint to remove that is absent",
     lambda: pg.IncrementalOptimizer().remove_constraint(0), ValueError, "constraint"),
    ("a pose of an empty optimizer", lambda: pg.IncrementalOptimizer().pose(0), ValueError, "id"),
    ("an added node of another kind", lambda: pg.IncrementalOptimizer(graph=ring()).add(plane()),
     ValueError, ""),
    # factor graphs
    ("a variable of two numbers", lambda: pg.FactorGraph().add_variable([1, 2]), ValueError,
     "value"),
    ("a variable that is None", lambda: pg.FactorGraph().add_variable(None), TypeError, "value"),
    ("a variable that is NaN", lambda: pg.FactorGraph().add_variable(float("nan")), ValueError,
     "value"),
    ("a factor of a variable that is absent",
     lambda: with_terms().add(pg.Factor.distance(1, sigma_m=1), [0, 5]), ValueError, "5"),
    ("a factor of other kinds", lambda: with_terms().add(pg.Factor.distance(1, sigma_m=1), [0, 1]),
     ValueError, "distance"),
    ("a factor of one variable twice",
     lambda: with_terms().add(pg.Factor.distance(1, sigma_m=1), [0, 0]), ValueError, "twice"),
    ("a value of another kind", lambda: with_terms().set_value(0, 1.0), ValueError, "value"),
    ("covariance of a held variable", lambda: with_terms().covariance([1]), ValueError, "held"),
    ("no sigma", lambda: pg.Factor.pose_prior(pg.SE3()), ValueError, "sigma"),
    ("sigma and information", lambda: pg.Factor.pose_prior(pg.SE3(), sigma=1, information=UNIT),
     ValueError, "information"),
    ("a negative sigma", lambda: pg.Factor.distance(1, sigma_m=-1), ValueError, "sigma_m"),
    ("sigmas of another number", lambda: pg.Factor.pose_prior(pg.SE3(), sigma=[1, 2]), ValueError,
     "sigma"),
    ("indefinite information of a factor",
     lambda: pg.Factor.position([0, 0, 0], information=np.diag([1.0, -1, 1])), ValueError,
     "information"),
    ("a direction of zeros", lambda: pg.Factor.bearing([0, 0, 0], sigma=1), ValueError, "direction"),
    ("an unknown kind of pose", lambda: pg.Factor.position([0, 0, 0], sigma=1, kind="SO3"),
     ValueError, "kind"),
    # factors written in Python
    ("a residual that is no function", factors(residual=3), ValueError, "residual"),
    ("a jacobian that is no function", factors(jacobian=3), ValueError, "jacobian"),
    ("a residual of text", factors(lambda x: "far", name="mine"), ValueError, "mine"),
    ("a residual without rows", factors(lambda x: [], name="mine"), ValueError, "mine"),
    ("a residual of None", factors(lambda x: None, name="mine"), ValueError, "mine"),
    ("a residual that becomes NaN", factors(later(1.0, np.nan), name="mine"), ValueError, "mine"),
    ("a residual that grows", factors(later(1.0, [1.0, 2.0]), name="mine"), ValueError, "mine"),
    ("a residual of too few variables", factors(lambda: 1.0), TypeError, "argument"),
    ("a residual that divides by zero", factors(lambda x: 1 / 0), ZeroDivisionError, "division"),
    ("a jacobian of another shape", factors(jacobian=lambda x: [np.eye(2)], name="mine"),
     ValueError, "mine"),
    ("a jacobian with NaN", factors(jacobian=lambda x: [[[np.nan]]], name="mine"), ValueError,
     "mine"),
    ("too many jacobians", factors(jacobian=lambda x: ([[1.0]], [[1.0]]), name="mine"), ValueError,
     "mine"),
    ("a jacobian that raises", factors(jacobian=lambda x: dict[str, float]()["key"]), KeyError, "key"),
    # smoothers
    ("a negative lag", lambda: pg.FixedLagSmoother(-1), ValueError, "lag"),
    ("a lag of text", lambda: pg.FixedLagSmoother("long"), TypeError, ""),  # type: ignore[arg-type]
    ("a time that is NaN", lambda: smoother().add_variable(float("nan"), 0.0), ValueError, "time"),
    ("a factor of what has left", lambda: smoother().add_residual(lambda x: x, [7]), ValueError, "7"),
    ("a value of what has left", lambda: smoother().value(7), ValueError, "7"),
    ("options of another kind for a smoother",
     lambda: pg.FixedLagSmoother(1, pg.RunOptions()), ValueError, "options"),  # type: ignore[arg-type]
]


def unposed() -> Any:
    networkx = pytest.importorskip("networkx")
    graph = networkx.MultiDiGraph()
    graph.add_node(0)
    return graph


def named() -> Any:
    networkx = pytest.importorskip("networkx")
    graph = networkx.MultiDiGraph()
    graph.add_node("a", pose=pg.SE3())
    return graph


@pytest.mark.parametrize(("call", "kind", "text"), [case[1:] for case in CASES],
                         ids=[case[0] for case in CASES])
def test_wrong_input_is_named(call: Callable[[], Any], kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as raised:
        call()
    assert text in str(raised.value)


def test_a_broken_file_is_named_with_its_line(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "broken.g2o"
    path.write_text("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0\n")
    with pytest.raises(OSError, match="broken.g2o:2"):
        pg.PoseGraph.read(str(path))


def test_a_view_outlives_its_report() -> None:
    view = pg.optimize(ring(noise=0.02)).chi2_by_constraint
    kept = view.copy()
    pg.optimize(ring(20, noise=0.05))
    np.testing.assert_array_equal(view, kept)
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 1
