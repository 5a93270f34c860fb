"""Pose graphs against gtsam: costs, minima and covariances. Runs only beside gtsam."""

from typing import Any

import numpy as np
import pytest

gtsam = pytest.importorskip("gtsam")

import placegraph as pg  # noqa: E402
from graph_samples import one_sign, plane, ring  # noqa: E402
from placegraph.gtsam import (factor_graph_from_gtsam, factor_graph_to_gtsam,  # noqa: E402
                              from_gtsam, to_gtsam)

ORDER = [3, 4, 5, 0, 1, 2]  # of our coordinates in those of a Pose3


def anisotropic(graph: pg.PoseGraph) -> pg.PoseGraph:
    """The graph with full information of different size in every direction."""
    random = np.random.default_rng(8)
    roots = random.normal(size=graph.information.shape)
    information = roots @ roots.transpose(0, 2, 1) + np.diag(np.arange(1.0, roots.shape[1] + 1))
    return pg.PoseGraph.from_arrays(graph.ids, graph.poses, graph.edges, graph.measurements,
                                    information, graph.sources)


@pytest.mark.parametrize("graph", [anisotropic(ring(12, noise=0.1)), anisotropic(plane())],
                         ids=["space", "plane"])
def test_costs_are_equal(graph: pg.PoseGraph) -> None:
    factors, values = to_gtsam(graph)
    assert 2 * factors.error(values) == pytest.approx(graph.chi2(), rel=1e-9)
    solved = pg.optimize(graph)
    assert list(values.keys()) == graph.ids.tolist()
    assert 2 * factors.error(to_gtsam(solved.graph)[1]) == pytest.approx(solved.chi2_final,
                                                                         rel=1e-9)


@pytest.mark.parametrize("graph", [ring(12, noise=0.03), plane()], ids=["space", "plane"])
def test_minima_are_equal(graph: pg.PoseGraph) -> None:
    factors, values = to_gtsam(graph)
    result = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
    ours = pg.optimize(graph)
    assert 2 * factors.error(result) == pytest.approx(ours.chi2_final, rel=1e-4)
    np.testing.assert_allclose(one_sign(from_gtsam(factors, result).poses),
                               one_sign(ours.graph.poses), atol=1e-2)


def test_marginal_covariances_are_equal() -> None:
    graph = pg.optimize(anisotropic(ring(10, noise=0.01))).graph
    factors, values = to_gtsam(graph, hold=False)
    # gtsam has no exact hold in its linear graph: a prior of great weight stands for it.
    factors.add(gtsam.PriorFactorPose3(0, values.atPose3(0),
                                       gtsam.noiseModel.Isotropic.Sigma(6, 1e-6)))
    theirs = gtsam.Marginals(factors, values)
    ours = pg.marginal_covariances(graph)
    inverse = np.argsort(ORDER)
    for node in range(1, 10):
        expected = theirs.marginalCovariance(node)[np.ix_(ORDER, ORDER)]
        np.testing.assert_allclose(ours[node], expected, atol=1e-6 * np.abs(expected).max())
    joint = np.asarray(pg.PoseMarginals(graph).joint_covariance([3, 7]))
    block = theirs.jointMarginalCovariance(gtsam.KeyVector([3, 7])).at(3, 7)
    np.testing.assert_allclose(joint[:6, 6:][np.ix_(inverse, inverse)], block,
                               atol=1e-6 * np.abs(joint).max())


@pytest.mark.parametrize("graph", [anisotropic(ring(12, noise=0.1)), anisotropic(plane())],
                         ids=["space", "plane"])
def test_there_and_back(graph: pg.PoseGraph) -> None:
    again = from_gtsam(*to_gtsam(graph))
    np.testing.assert_allclose(one_sign(again.poses), one_sign(graph.poses), atol=1e-12)
    np.testing.assert_allclose(one_sign(again.measurements), one_sign(graph.measurements), atol=1e-12)
    np.testing.assert_allclose(again.information, graph.information, rtol=1e-9, atol=1e-9)
    assert again.edges.tolist() == graph.edges.tolist() and again.fixed.tolist() == [0]
    assert again.chi2() == pytest.approx(graph.chi2(), rel=1e-9)


@pytest.mark.parametrize("graph", [ring(12, noise=0.03), plane()], ids=["space", "plane"])
def test_a_prior_holds_its_node(graph: pg.PoseGraph) -> None:
    factors, values = to_gtsam(graph, hold=False)
    kind = "Pose2" if graph.kind == "SE2" else "Pose3"
    prior = getattr(gtsam, f"PriorFactor{kind}")
    factors.add(prior(0, getattr(values, f"at{kind}")(0),
                      gtsam.noiseModel.Isotropic.Sigma(graph.information.shape[1], 1e-6)))
    result = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
    again = from_gtsam(factors, result)
    assert again.fixed.tolist() == [0] and again.edges.tolist() == graph.edges.tolist()
    assert pg.optimize(again).chi2_final == pytest.approx(2 * factors.error(result), rel=1e-4)


def chain_with_priors(random: np.random.Generator) -> tuple[Any, Any]:
    """A chain in the plane, one or two of whose poses have priors at their values."""
    factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    count = int(random.integers(2, 6))
    for i in range(count):
        values.insert(i, gtsam.Pose2(i, 0, 0))
        if i:
            sigmas = 10.0 ** random.uniform(-2, -1, 3)
            factors.add(gtsam.BetweenFactorPose2(i - 1, i, gtsam.Pose2(1.1, 0, 0),
                                                 gtsam.noiseModel.Diagonal.Sigmas(sigmas)))
    for node in random.choice(count, int(random.integers(1, 3)), replace=False).tolist():
        sigmas = np.full(3, 10.0 ** random.uniform(-7, 1))
        sigmas[int(random.integers(3))] *= random.choice([1, 1, 1e6, np.inf])
        model = gtsam.noiseModel.Diagonal.Sigmas(sigmas)
        factors.add(gtsam.PriorFactorPose2(node, values.atPose2(node), model))
    return factors, values


def test_a_prior_is_exact_or_refused() -> None:
    random = np.random.default_rng(5)
    converted = 0
    for trial in range(200):
        factors, values = chain_with_priors(random)
        try:
            graph = from_gtsam(factors, values)
        except ValueError as error:
            assert "is a measurement" in str(error), trial
            continue
        converted += 1
        theirs = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
        ours = pg.optimize(graph).graph.poses
        expected = [theirs.atPose2(i).translation() for i in range(len(ours))]
        np.testing.assert_allclose(ours[:, :2], expected, atol=1e-5, err_msg=str(trial))
        if len(ours) > 1:
            last = gtsam.Marginals(factors, theirs).marginalCovariance(len(ours) - 1)
            covariance = pg.marginal_covariances(pg.optimize(graph).graph)[-1]
            np.testing.assert_allclose(covariance, last, atol=1e-5, err_msg=str(trial))
    assert converted > 20


def robust_cost(graph: pg.PoseGraph) -> float:
    squares = pg.FactorGraph.from_pose_graph(graph).squared_residuals()
    return float(sum(k.rho(s or 0.0) for k, s in zip(graph.kernels, squares)))


@pytest.mark.parametrize("kind", ["huber", "cauchy", "tukey"])
def test_kernels_and_positions_are_equal(kind: str) -> None:
    graph = ring(8, noise=0.05)
    kernel = pg.RobustKernel(kind, 1.3)
    graph.add_edge(0, 5, graph.pose(3), np.diag([1.0, 2, 3, 4, 5, 6]), "loop", kernel)
    graph.add_position(2, [1, 2, 3], np.diag([1.0, 2, 3]))
    factors, values = to_gtsam(graph)
    assert 2 * factors.error(values) == pytest.approx(robust_cost(graph), rel=1e-9)
    again = from_gtsam(factors, values)
    assert [(k.kind, k.width) for k in again.kernels if k.kind != "none"] == [(kind, 1.3)]
    np.testing.assert_allclose(again.position_information, graph.position_information)
    graph.add_position(2, [1, 2, 3], np.eye(3), [0.5, 0, 0.1])
    factors, values = to_gtsam(graph)
    assert 2 * factors.error(values) == pytest.approx(robust_cost(graph), rel=1e-9)


def x(i: int) -> int:
    return int(gtsam.symbol("x", i))


def measured_in_space() -> tuple[Any, Any]:
    """Factors of every kind that a factor graph takes, beside poses x and points l."""
    random = np.random.default_rng(3)
    factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    poses = [gtsam.Pose3.Expmap(0.1 * random.normal(size=6)) for _ in range(4)]
    for i, pose in enumerate(poses):
        values.insert(x(i), pose)
    model = gtsam.noiseModel.Diagonal.Sigmas(10.0 ** random.uniform(-2, 0, 6))
    robust = gtsam.noiseModel.Robust.Create(gtsam.noiseModel.mEstimator.Huber.Create(0.5), model)
    for i in range(4):
        moved = poses[i].retract(0.05 * random.normal(size=6))
        factors.add(gtsam.PriorFactorPose3(x(i), moved, model))
        factors.add(gtsam.GPSFactor(x(i), random.normal(size=3),
                                    gtsam.noiseModel.Diagonal.Sigmas([0.1, 0.2, 0.3])))
        factors.add(gtsam.GPSFactorArm(x(i), random.normal(size=3), [0.5, -0.2, 0.1],
                                       gtsam.noiseModel.Isotropic.Sigma(3, 0.5)))
    for i in range(3):
        moved = poses[i].between(poses[i + 1]).retract(0.05 * random.normal(size=6))
        factors.add(gtsam.BetweenFactorPose3(x(i), x(i + 1), moved, robust))
        factors.add(gtsam.RangeFactorPose3(x(i), x(3), 0.7, gtsam.noiseModel.Isotropic.Sigma(1, 0.2)))
    K = gtsam.Cal3_S2(500, 510, 0, 320, 240)
    for j in range(5):
        key, point = int(gtsam.symbol("l", j)), np.array([*random.uniform(-1, 1, 2), 4.0])
        values.insert(key, point)
        for i in range(4):
            px = gtsam.PinholeCameraCal3_S2(poses[i], K).project(point) + random.normal(size=2)
            factors.add(gtsam.GenericProjectionFactorCal3_S2(
                px, gtsam.noiseModel.Diagonal.Sigmas([1.0, 2.0]), x(i), key, K))
    return factors, values


def measured_in_the_plane() -> tuple[Any, Any]:
    factors, values = to_gtsam(anisotropic(plane()), hold=False)
    model = gtsam.noiseModel.Diagonal.Sigmas([0.1, 0.2, 0.3])
    factors.add(gtsam.PriorFactorPose2(3, gtsam.Pose2(3, 1, 0.3), model))
    for i in range(3):
        factors.add(gtsam.RangeFactorPose2(i, 3, 1.7, gtsam.noiseModel.Isotropic.Sigma(1, 0.2)))
    factors.add(gtsam.NonlinearEqualityPose2(0, values.atPose2(0)))
    return factors, values


@pytest.mark.parametrize("made", [measured_in_space, measured_in_the_plane], ids=["space", "plane"])
def test_factor_graphs_have_the_costs_and_minima_of_gtsam(made: Any) -> None:
    factors, values = made()
    graph, variables = factor_graph_from_gtsam(factors, values)
    assert sorted(variables) == sorted(values.keys()) and len(graph) == len(variables)
    report = pg.optimize_factors(graph)
    assert report.cost_initial == pytest.approx(factors.error(values), rel=1e-9)
    params = gtsam.LevenbergMarquardtParams()
    params.setMaxIterations(1000)
    params.setRelativeErrorTol(1e-12)
    theirs = gtsam.LevenbergMarquardtOptimizer(factors, values, params).optimize()
    assert report.cost_final == pytest.approx(factors.error(theirs), rel=1e-4)


def with_factors_of_ours() -> pg.FactorGraph:
    """Variables of every kind that gtsam has, with factors and kernels that it has not."""
    graph = pg.FactorGraph()
    first = graph.add_variable(pg.SE3(), held=True)
    second = graph.add_variable(pg.SE3.from_quaternion_xyzw([0.1, -0.2, 0.1, 1], [1, 0.2, 0]))
    scale = graph.add_variable(1.3)
    offset = graph.add_variable(0.4, held=True)
    point = graph.add_variable(np.array([0.5, 0.2, 4.0]))
    frame = graph.add_variable(pg.SO3.exp([0.1, 0.2, 0.3]))
    graph.add(pg.Factor.relative_pose(pg.SE3.from_quaternion_xyzw([0, 0, 0.1, 1], [1.1, 0, 0]), sigma=0.1),
              [first, second], pg.RobustKernel("cauchy", 0.7))
    graph.add(pg.Factor.non_holonomic([0, 1, 0], 0.05), [first, second])
    graph.add(pg.Factor.absolute_rotation(pg.SO3.exp([0, 0.2, 0.2]), sigma=0.1), [second, frame])
    graph.add(pg.Factor.absolute_rotation(pg.SO3.exp([0.1, 0.1, 0.3]), sigma=0.1), [first, frame])
    for pose in (first, second):
        graph.add(pg.Factor.point_in_node([0.4, 0.1, 4.1], information=np.diag([1.0, 4, 9])),
                  [pose, point])
    graph.add_residual(lambda s, o, p: s * p[:2] - o * np.array([1.0, 0.5]),
                       [scale, offset, point], sigma=[0.1, 0.2])
    return graph


def test_factors_of_every_kind_have_the_same_costs_and_minima_in_gtsam() -> None:
    graph = with_factors_of_ours()
    report = pg.optimize_factors(graph)
    factors, values = factor_graph_to_gtsam(graph)
    assert factors.error(values) == pytest.approx(report.cost_initial, rel=1e-9)
    params = gtsam.LevenbergMarquardtParams()
    params.setMaxIterations(200)
    params.setRelativeErrorTol(1e-12)
    theirs = gtsam.LevenbergMarquardtOptimizer(factors, values, params).optimize()
    assert factors.error(theirs) == pytest.approx(report.cost_final, rel=1e-4)
    np.testing.assert_allclose(theirs.atPose3(0).matrix(), np.eye(4), atol=1e-9)


@pytest.mark.parametrize("made", [measured_in_space, measured_in_the_plane], ids=["space", "plane"])
def test_factor_graphs_return_to_gtsam_with_their_costs(made: Any) -> None:
    factors, values = made()
    again, start = factor_graph_to_gtsam(factor_graph_from_gtsam(factors, values)[0])
    assert again.error(start) == pytest.approx(factors.error(values), rel=1e-9)


def test_variables_that_gtsam_has_not_are_refused_by_name() -> None:
    graph = pg.FactorGraph()
    graph.add_variable(pg.SE3())
    graph.add_variable(pg.Sim3())
    with pytest.raises(pg.ArgumentError, match="variable 1 is a Sim3, which is not converted"):
        factor_graph_to_gtsam(graph)
    with pytest.raises(pg.ArgumentError, match="term: there is no term 0"):
        graph.term(0)


def test_an_equality_holds_a_variable() -> None:
    factors, values = measured_in_the_plane()
    graph, variables = factor_graph_from_gtsam(factors, values)
    assert [key for key, i in variables.items() if graph.is_held(i)] == [0]
    exact = gtsam.noiseModel.Constrained.All(3)
    factors.add(gtsam.PriorFactorPose2(2, values.atPose2(2), exact))
    graph, variables = factor_graph_from_gtsam(factors, values)
    assert [key for key, i in variables.items() if graph.is_held(i)] == [0, 2]
    factors, values = to_gtsam(plane())
    factors.add(gtsam.PriorFactorPose2(2, values.atPose2(2), exact))
    assert from_gtsam(factors, values).fixed.tolist() == [0, 2]


def refused(add: Any, convert: Any) -> str:
    """What is said of the factors of two poses, x0 and x1, to which `add` adds one."""
    factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    for i in range(2):
        values.insert(x(i), gtsam.Pose2(i, 0, 0))
    unit = gtsam.noiseModel.Unit.Create(3)
    factors.add(gtsam.BetweenFactorPose2(x(0), x(1), gtsam.Pose2(1, 0, 0), unit))
    factors.add(add(unit))
    with pytest.raises(pg.ArgumentError) as raised:
        convert(factors, values)
    return str(raised.value)


def test_factors_and_keys_are_named_as_gtsam_prints_them() -> None:
    bearing = gtsam.noiseModel.Unit.Create(1)
    for convert in (from_gtsam, factor_graph_from_gtsam):
        said = refused(lambda _: gtsam.BearingFactorPose2(x(0), x(1), gtsam.Rot2(), bearing), convert)
        assert said == "factors: factor 1, a BearingFactorPose2 of x0, x1, is not converted"
        said = refused(lambda unit: gtsam.BetweenFactorPose2(x(1), x(7), gtsam.Pose2(), unit),
                       convert)
        assert said == "factors: factor 1, a BetweenFactorPose2 of x1, x7: there is no value of x7"
        said = refused(lambda unit: gtsam.BetweenFactorPose2(x(1), x(1), gtsam.Pose2(), unit),
                       convert)
        assert said == "factors: factor 1, a BetweenFactorPose2 of x1, x1, has a key twice"
        said = refused(lambda _: gtsam.NonlinearEqualityPose2(x(1), gtsam.Pose2(5, 0, 0)), convert)
        assert said.startswith("factors: factor 1, a NonlinearEqualityPose2 of x1, differs from")
    said = refused(lambda unit: gtsam.PriorFactorPose2(x(0), gtsam.Pose2(), unit), from_gtsam)
    assert "a PriorFactorPose2 of x0, has standard deviations above 0.001: it is a measurement" in said
    values = gtsam.Values()
    values.insert(x(2), gtsam.Pose2())
    values.insert(x(3), gtsam.Pose3())
    with pytest.raises(pg.ArgumentError, match="the value of x3: pose: its kind"):
        from_gtsam(gtsam.NonlinearFactorGraph(), values)
    values = gtsam.Values()
    values.insert(x(3), 1.0)
    for convert in (from_gtsam, factor_graph_from_gtsam):
        with pytest.raises(pg.ArgumentError, match="the value of x3 is not a"):
            convert(gtsam.NonlinearFactorGraph(), values)


def test_an_older_gtsam_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.version", lambda name: "4.2.2")
    with pytest.raises(ImportError, match=r"gtsam 4\.2\.2 is installed.* 4\.3 or later"):
        to_gtsam(plane())
    monkeypatch.setattr("importlib.metadata.version", lambda name: "4.10a1")
    to_gtsam(plane())


def test_what_has_no_counterpart_is_refused() -> None:
    similar = pg.PoseGraph()
    similar.add_node(0, pg.Sim3())
    with pytest.raises(ValueError, match="Sim3"):
        to_gtsam(similar)
    negative = pg.PoseGraph()
    negative.add_node(-1, pg.SE3())
    with pytest.raises(ValueError, match="-1"):
        to_gtsam(negative)
    graph = ring(8)
    graph.add_edge(0, 5, pg.SE3(), np.eye(6), "loop", pg.RobustKernel("truncated", 1))
    with pytest.raises(ValueError, match="truncated"):
        to_gtsam(graph)
    factors, values = to_gtsam(ring(8))
    other = values.atPose3(0).compose(gtsam.Pose3(gtsam.Rot3(), [1e-3, 0, 0]))
    factors.add(gtsam.PriorFactorPose3(0, other, gtsam.noiseModel.Unit.Create(6)))
    with pytest.raises(ValueError, match="PriorFactorPose3 of 0, differs from the value of its"):
        from_gtsam(factors, values)
    factors, values = to_gtsam(ring(8))
    values.insert(99, 1.0)
    with pytest.raises(ValueError, match="99"):
        from_gtsam(factors, values)
