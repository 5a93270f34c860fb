"""Pose graphs against gtsam: costs, minima and covariances. Runs only beside gtsam."""

from typing import Any

import numpy as np
import pytest

gtsam = pytest.importorskip("gtsam")

import placegraph as pg  # noqa: E402
from graph_samples import one_sign, plane, ring  # noqa: E402
from placegraph.gtsam import from_gtsam, to_gtsam  # noqa: E402

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
