"""The incremental optimizer, fed pose by pose."""

import numpy as np
import pytest

import placegraph as pg
from graph_samples import ring


def steps_of(graph: pg.PoseGraph) -> list[pg.PoseGraph]:
    """The graph in parts: every pose with its edges to earlier ones."""
    parts = []
    for i, row in enumerate(graph.poses):
        part = pg.PoseGraph()
        part.add_node(i, row)
        for (begin, end), measured, information, source in zip(
                graph.edges.tolist(), graph.measurements, graph.information, graph.sources):
            if max(begin, end) == i:
                part.add_edge(begin, end, measured, information, source)
        parts.append(part)
    return parts


def test_it_ends_at_the_minimum_of_the_whole_graph() -> None:
    graph = ring(30, noise=0.02)
    incremental = pg.IncrementalOptimizer()
    first = 0
    for part in steps_of(graph):
        step = incremental.add(part)
        assert step.ok and step.first_constraint == first
        first += part.constraints
    assert incremental.finish().ok
    batch = pg.optimize(graph)
    assert incremental.cost == pytest.approx(batch.chi2_final, rel=1e-6)
    np.testing.assert_allclose(incremental.poses, batch.graph.poses, atol=1e-4)
    assert incremental.constraints == graph.constraints and len(incremental.graph) == 30
    np.testing.assert_allclose(incremental.pose(7).translation, batch.graph.poses[7, :3], atol=1e-4)


def test_a_false_loop_can_be_removed_and_restored() -> None:
    graph = ring(20, noise=0.01)
    incremental = pg.IncrementalOptimizer(graph=graph)
    incremental.finish()
    clean = incremental.cost
    loop = pg.PoseGraph()
    loop.add_edge(2, 12, pg.SE3(), 10 * np.eye(6), "loop")
    number = incremental.add(loop).first_constraint
    assert number == graph.constraints and incremental.cost > 10 * clean
    incremental.remove_constraint(number)
    incremental.finish()
    assert incremental.cost == pytest.approx(clean, rel=1e-5)
    assert incremental.graph.constraints == graph.constraints
    incremental.reweight([number], [0.5])
    assert incremental.graph.constraints == graph.constraints + 1


def test_covariances_are_those_of_the_batch() -> None:
    graph = pg.optimize(ring(12, noise=0.02)).graph
    incremental = pg.IncrementalOptimizer(graph=graph)
    incremental.finish()
    marginals = pg.PoseMarginals(incremental.graph)
    expected = np.asarray(marginals.joint_covariance([9, 4]))
    np.testing.assert_allclose(incremental.covariance([9, 4]), expected,
                               atol=1e-3 * np.abs(expected).max())
    np.testing.assert_allclose(incremental.relative_covariance(4, 9),
                               marginals.relative_covariance(4, 9),
                               atol=1e-3 * np.abs(expected).max())
