"""Factor graphs: ready factors, factors written in Python, and the fixed-lag smoother."""

import gc
import threading
import weakref
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from graph_samples import plane, ring

CAMERA = pg.Camera(640, 480, 500, 510, 320, 240)
T_A = pg.SE3.exp([0.1, 0.2, 0.3, 0.05, -0.1, 0.02])
T_B = pg.SE3.exp([1.0, -0.2, 0.5, 0.2, 0.1, -0.3])
POINT = np.array([0.4, -0.3, 6.0])
PLANE = pg.Plane3([0.1, 1.0, 0.05], 1.6)
WALL = pg.Plane3([1.0, 0.1, 0.0], 4.0)
TURN = pg.SO3.exp([0.1, 0.4, -0.2])
INFORMATION = np.diag([4.0, 9, 16]) + 0.5

# A ready factor, values at which its derivatives are checked, and its residual by a formula.
READY: list[tuple[pg.Factor, list[Any], Any]] = [
    (pg.Factor.relative_pose(T_A, sigma=0.5), [T_A, T_B],
     lambda a, b: (T_A.inverse() * a.inverse() * b).log() / 0.5),
    (pg.Factor.relative_pose(pg.SE2(1, 2, 0.3), sigma=[1, 2, 3]),
     [pg.SE2(0, 1, 0.5), pg.SE2(1, 3, 0.7)],
     lambda a, b: (pg.SE2(1, 2, 0.3).inverse() * a.inverse() * b).log() / [1, 2, 3]),
    (pg.Factor.pose_prior(T_A, sigma=2.0), [T_B], lambda a: (T_A.inverse() * a).log() / 2),
    (pg.Factor.position([1, 2, 3], sigma=0.1, lever_arm=[0.1, 0, 0.2]), [T_B],
     lambda a: (a.transform([[0.1, 0, 0.2]])[0] - [1, 2, 3]) / 0.1),
    (pg.Factor.distance(2.0, sigma_m=0.1), [T_A, T_B],
     lambda a, b: [(np.linalg.norm(b.translation - a.translation) - 2) / 0.1]),
    (pg.Factor.bearing([1, 0, 1], sigma=0.2), [T_A, T_B],
     lambda a, b: (a.inverse() * b).translation / np.linalg.norm((a.inverse() * b).translation) / 0.2
     - np.array([1, 0, 1]) / np.sqrt(2) / 0.2),
    (pg.Factor.non_holonomic([1, 0, 0], 0.05), [T_A, T_B],
     lambda a, b: [((a.inverse() * b).translation[0] - (b.inverse() * a).translation[0]) / 0.1]),
    (pg.Factor.absolute_rotation(TURN, sigma=0.1), [T_A, pg.SO3.exp([0, 0.1, 0])],
     lambda a, m: (m.inverse() * pg.SO3(a.quaternion_xyzw) * TURN).log() / 0.1),
    (pg.Factor.plane_observation(PLANE, sigma=0.1), [T_A, pg.Plane3([0.2, 1.0, 0.1], 1.7)], None),
    (pg.Factor.plane_parallel(0.1), [PLANE, WALL],
     lambda a, b: np.cross(a.normal, b.normal) / 0.1),
    (pg.Factor.plane_orthogonal(0.1), [PLANE, WALL], lambda a, b: [a.normal @ b.normal / 0.1]),
    (pg.Factor.point_on_plane(0.1), [POINT, PLANE],
     lambda p, a: [(a.normal @ p - a.distance) / 0.1]),
    (pg.Factor.point_in_node([0.1, 0.2, 5], sigma=0.5), [T_A, POINT],
     lambda a, p: (a.inverse().transform(p[None])[0] - [0.1, 0.2, 5]) / 0.5),
    (pg.Factor.reprojection(CAMERA, [300, 200], sigma_px=2.0), [T_A, POINT],
     lambda a, p: (CAMERA.project(a.inverse().transform(p[None]))[0] - [300, 200]) / 2),
    (pg.Factor.inverse_depth(0.2, sigma=0.1), [T_A, POINT],
     lambda a, p: [(1 / a.inverse().transform(p[None])[0, 2] - 0.2) / 0.1, 0]),
    (pg.Factor.line_reprojection(CAMERA, [100, 100], [400, 120], sigma_px=1.0),
     [T_A, pg.Line3.from_direction([0, 1, 6], [1, 0.1, 0.2])], None),
]


@pytest.mark.parametrize(("factor", "values", "formula"), READY, ids=[f[0].name for f in READY])
def test_ready_factors_have_the_residuals_and_derivatives_they_say(
    factor: pg.Factor, values: list[Any], formula: Any
) -> None:
    r = np.asarray(factor.residual(*values))
    assert r.shape == (factor.residual_size,)
    if formula is not None:
        np.testing.assert_allclose(r, formula(*values), atol=1e-12 * max(1, np.abs(r).max()))
    numeric = pg.Factor.custom(factor.residual, values)
    analytic, expected = factor.jacobians(*values), numeric.jacobians(*values)
    assert analytic is not None and expected is not None
    for given, differences in zip(analytic, expected):
        np.testing.assert_allclose(given, differences, atol=1e-6 * max(1, np.abs(given).max()))


def test_information_weighs_as_its_root() -> None:
    e = np.asarray(pg.Factor.position([0, 0, 0], sigma=1).residual(T_B))
    r = np.asarray(pg.Factor.position([0, 0, 0], information=INFORMATION).residual(T_B))
    assert r @ r == pytest.approx(e @ INFORMATION @ e)


def test_a_pose_graph_has_the_same_minimum_as_a_factor_graph() -> None:
    graph = ring(10, noise=0.02)
    factors = pg.FactorGraph.from_pose_graph(graph)
    report = pg.optimize_factors(factors)
    expected = pg.optimize(graph)
    assert report.ok and report.cost_final == pytest.approx(expected.chi2_final / 2, rel=1e-6)
    squares = [square or 0.0 for square in report.graph.squared_residuals()]
    assert sum(squares) == pytest.approx(expected.chi2_final, rel=1e-6)
    covariance = report.graph.covariance([3])
    np.testing.assert_allclose(covariance, pg.marginal_covariances(expected.graph, [3])[0],
                               rtol=1e-3, atol=1e-7)


def line_graph(residual: Any, jacobian: Any = None, **weight: Any) -> pg.FactorGraph:
    graph = pg.FactorGraph()
    slope, offset = graph.add_variable(0.0), graph.add_variable(0.0)
    x = np.linspace(0, 1, 9)
    y = 2 * x + 1 + 0.1 * np.cos(9 * x)
    for each, measured in zip(x.tolist(), y.tolist()):
        graph.add_residual(residual(each, measured), [slope, offset],
                           jacobian=jacobian and jacobian(each), **weight)
    return graph


def test_factors_in_python_fit_a_line_with_and_without_jacobian() -> None:
    x = np.linspace(0, 1, 9)
    expected = np.polyfit(x, 2 * x + 1 + 0.1 * np.cos(9 * x), 1)

    def residual(x: float, y: float) -> Any:
        return lambda a, b: a * x + b - y

    def jacobian(x: float) -> Any:
        return lambda a, b: ([[x]], [[1.0]])

    for graph in (line_graph(residual), line_graph(residual, jacobian, sigma=0.1)):
        report = pg.optimize_factors(graph)
        assert report.ok
        np.testing.assert_allclose([report.graph.value(0), report.graph.value(1)], expected,
                                   atol=1e-6)
        assert graph.value(0) == 0.0  # the graph stays as it is
    J = np.column_stack([x, np.ones(9)]) / 0.1
    np.testing.assert_allclose(graph.covariance([0, 1]), np.linalg.inv(J.T @ J), rtol=1e-6)


def test_every_kind_of_variable_reaches_python_and_comes_back() -> None:
    values: list[Any] = [2.5, pg.SE2(1, 2, 0.3), T_A, pg.Sim3([0, 0, 0, 1], [1, 2, 3], 1.5), TURN, POINT,
              pg.Line3.from_direction([0, 1, 6], [1, 0, 0]), PLANE, pg.Marker(T_B, 0.2)]
    kinds = ["scalar", "SE2", "SE3", "Sim3", "rotation", "point", "line", "plane", "marker"]
    graph = pg.FactorGraph()
    seen: list[type] = []
    for value in values:
        number = graph.add_variable(value)

        def residual(x: Any, target: Any = value) -> Any:
            seen.append(type(x))
            return np.atleast_1d(x - target if isinstance(x, (float, np.ndarray))
                                 else x.minus(target))

        graph.add_residual(residual, [number])
    assert [type(value) for value in values] == seen
    assert [graph.kind(i) for i in range(9)] == kinds
    moved = [values[0] + 0.1, *(v.plus(0.1 * np.ones(len(v.minus(v)))) for v in values[1:5]),
             POINT + 0.1, *(v.plus(0.1 * np.ones(len(v.minus(v)))) for v in values[6:])]
    for i, value in enumerate(moved):
        graph.set_value(i, value)
    report = pg.optimize_factors(graph)
    assert report.cost_initial > 0.01 and report.cost_final < 1e-12


def test_a_kernel_silences_an_outlier() -> None:
    graph = pg.FactorGraph()
    x = graph.add_variable(0.8)
    for measured in (0.9, 1.0, 1.1, 25.0):
        graph.add_residual(lambda v, m=measured: v - m, [x], sigma=0.1,
                           kernel=pg.RobustKernel("tukey", 4))
    assert pg.optimize_factors(graph).graph.value(x) == pytest.approx(1, abs=1e-5)


def test_an_exception_ends_the_solve_and_is_raised_as_it_is() -> None:
    calls = 0

    def residual(x: float) -> float:
        nonlocal calls
        calls += 1
        if calls > 4:
            raise KeyError("of mine")
        return x - 1

    graph = pg.FactorGraph()
    graph.add_residual(residual, [graph.add_variable(0.0)])
    with pytest.raises(KeyError, match="of mine"):
        pg.optimize_factors(graph)
    assert calls == 5


def test_none_makes_the_solver_try_a_shorter_step() -> None:
    graph = pg.FactorGraph()
    x = graph.add_variable(0.1)
    graph.add_residual(lambda v: None if v <= 0 else np.log(v) + 1, [x])
    report = pg.optimize_factors(graph)
    assert report.ok and report.graph.value(x) == pytest.approx(np.exp(-1))


def test_functions_are_freed_with_their_graph() -> None:
    class Owner:
        def __init__(self) -> None:
            self.graph = pg.FactorGraph()
            self.graph.add_residual(self.residual, [self.graph.add_variable(0.0)])

        def residual(self, x: float) -> float:
            return x

    owner = Owner()
    gone = weakref.ref(owner)
    pg.optimize_factors(owner.graph)
    del owner
    gc.collect()
    assert gone() is None


def test_threads_solve_at_once() -> None:
    results: list[float] = []

    def solve() -> None:
        graph = line_graph(lambda x, y: lambda a, b: a * x + b - y)
        results.append(pg.optimize_factors(graph).cost_final)

    threads = [threading.Thread(target=solve) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4 and len(set(results)) == 1


def test_the_smoother_equals_the_batch_on_a_line() -> None:
    random = np.random.default_rng(3)
    smoother, batch = pg.FixedLagSmoother(5), pg.FactorGraph()

    def difference(measured: float) -> Any:
        return lambda a, b: b - a - measured

    for i in range(30):
        assert smoother.add_variable(i, 0.0) == batch.add_variable(0.0) == i
        start, step, jump = random.normal(size=3).tolist()
        for graph in (smoother, batch):
            if i % 7 == 0:
                graph.add_residual(lambda a, m=start: a - m, [i], sigma=0.5)
            if i > 0:
                graph.add_residual(difference(step), [i - 1, i], sigma=0.1)
            if i > 3:
                graph.add_residual(difference(jump), [i - 4, i], sigma=0.3)
        assert smoother.update().ok
    assert smoother.variables == tuple(range(24, 30))
    expected = pg.optimize_factors(batch).graph
    for i in smoother.variables:
        assert smoother.value(i) == pytest.approx(expected.value(i), abs=1e-5)
    np.testing.assert_allclose(smoother.covariance([29, 25]), expected.covariance([29, 25]),
                               rtol=1e-6)


def test_the_smoother_keeps_what_is_touched() -> None:
    smoother = pg.FixedLagSmoother(1.0)
    held = smoother.add_variable(0, pg.SE3(), held=True)
    late = smoother.add_variable(5, pg.SE3())
    landmark = smoother.add_variable(0, [0.0, 0, 5])
    smoother.touch(landmark, 4.5)
    smoother.add(pg.Factor.point_in_node([0, 0, 6], sigma=0.1), [held, landmark])
    smoother.add(pg.Factor.point_in_node([1, 0, 6], sigma=0.1), [late, landmark])
    smoother.add(pg.Factor.pose_prior(pg.SE3(), sigma=1.0), [late])
    step = smoother.update()
    assert step.ok and step.marginalized == (held,) and smoother.variables == (late, landmark)
    np.testing.assert_allclose(smoother.value(landmark), [0, 0, 6], atol=1e-2)
    assert len(smoother.window()) == 2


def test_the_smoother_forgets_its_functions_with_their_variables() -> None:
    smoother = pg.FixedLagSmoother(2.0)
    gone: list[weakref.ref[Any]] = []
    for i in range(6):
        number = smoother.add_variable(i, pg.SE3())

        def residual(T: pg.SE3) -> Any:
            return T.translation if smoother else None

        gone.append(weakref.ref(residual))
        smoother.add_residual(residual, [number])
        del residual
        assert smoother.update().ok
    gc.collect()
    assert [function() is None for function in gone] == [True] * 3 + [False] * 3
    del smoother
    gc.collect()
    assert all(function() is None for function in gone)


def test_a_smoother_is_not_used_while_it_is_updated() -> None:
    smoother = pg.FixedLagSmoother(1.0)
    x = smoother.add_variable(0, 0.0)
    smoother.add_residual(lambda v: v - 1, [x])
    armed = False

    def residual(v: float) -> float:
        if armed:
            smoother.add_variable(1, 0.0)
        return v

    smoother.add_residual(residual, [x])
    armed = True
    with pytest.raises(ValueError, match="FixedLagSmoother"):
        smoother.update()
    armed = False
    assert smoother.update().ok and smoother.value(x) == pytest.approx(0.5, abs=1e-6)


def test_positions_in_the_plane() -> None:
    graph = pg.FactorGraph.from_pose_graph(plane())
    graph.hold(0, False)
    graph.add(pg.Factor.position([5, 0, 0], sigma=0.1, kind="SE2"), [0])
    assert pg.optimize_factors(graph).graph.value(0).translation == pytest.approx([5, 0], abs=1e-5)
