"""Graphs with priors and points: files, optimization, covariances."""

import pathlib

import numpy as np
import pytest

import placegraph as pg


def walk() -> pg.LandmarkGraph:
    """Five poses along a line with noise, a point that all see, and a GPS-like prior."""
    random = np.random.default_rng(2)
    poses = pg.PoseGraph()
    for i in range(5):
        poses.add_node(i, [i, 0, 0])
    for i in range(4):
        poses.add_edge(i, i + 1, [1, 0, 0] + 0.05 * random.standard_normal(3),
                       np.diag([400, 400, 400]))
    graph = pg.LandmarkGraph(poses)
    graph.add_point(10, [2, 3])
    for i in range(5):
        graph.add_observation(i, 10, [2 - i, 3] + 0.1 * random.standard_normal(2), 100 * np.eye(2))
    graph.add_prior(4, [4.1, 0.05, 0.01], 100 * np.eye(3))
    return graph


def dense(graph: pg.LandmarkGraph) -> np.ndarray:
    """The inverse of J^T J by finite differences, of all variables in the order of poses, points."""
    poses, points = np.array(graph.poses.poses), np.array(graph.points)
    measured = {tuple(e): m for e, m in zip(graph.poses.edges.tolist(), graph.poses.measurements)}

    def inverse_of(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array((pg.SE2(*a).inverse() * pg.SE2(*b)).log())

    def errors(tangent: np.ndarray) -> np.ndarray:
        moved = []
        for i, p in enumerate(poses):
            T = pg.SE2(*p) * pg.SE2.exp(tangent[3 * i:3 * i + 3])
            moved.append(T)
        q = points[0] + tangent[15:17]
        e = []
        for (a, b), z in measured.items():
            e.append(20 * np.array((pg.SE2(*z).inverse() * (moved[a].inverse() * moved[b])).log()))
        for i, z in zip(graph.observing_nodes, graph.observed_positions):
            e.append(10 * ((moved[i].inverse().matrix() @ [*q, 1])[:2] - z))
        e.append(10 * np.array((pg.SE2(*graph.prior_poses[0]).inverse() * moved[4]).log()))
        return np.concatenate(e)

    step = 1e-6
    J = np.stack([(errors(step * d) - errors(-step * d)) / (2 * step) for d in np.eye(17)], axis=1)
    return np.linalg.inv(J.T @ J)


def test_covariances_are_those_of_the_dense_normal_equations() -> None:
    solved = pg.optimize(walk()).graph
    marginals, expected = pg.PoseMarginals(solved), dense(solved)
    assert marginals.covariances() == pytest.approx(
        np.stack([expected[k:k + 3, k:k + 3] for k in range(0, 15, 3)]), rel=1e-4, abs=1e-9)
    assert marginals.point_covariances()[0] == pytest.approx(expected[15:, 15:], rel=1e-4)
    assert marginals.covariance(10) == pytest.approx(expected[15:, 15:], rel=1e-4)
    joint = marginals.joint_covariance([4, 10])
    assert joint == pytest.approx(expected[12:, 12:], rel=1e-4, abs=1e-9)


def test_a_file_is_written_and_read(tmp_path: pathlib.Path) -> None:
    graph = walk()
    graph.write(tmp_path / "walk.g2o")
    again = pg.LandmarkGraph.read(tmp_path / "walk.g2o")
    assert again.chi2() == pytest.approx(graph.chi2(), rel=1e-12)
    assert again.points.tolist() == graph.points.tolist() and again.point_ids.tolist() == [10]
    with pytest.raises(pg.FileError, match="priors or point landmarks"):
        pg.PoseGraph.read(tmp_path / "walk.g2o")


def test_what_is_free_is_refused_with_its_ids() -> None:
    graph = walk()
    graph.add_point(11, [0, 0])
    graph.add_observation(2, 11, [1, 1], np.diag([1.0, 0.0]))
    with pytest.raises(pg.NoResult, match="undetermined, of 11$"):
        pg.PoseMarginals(graph)


def test_wrong_entries_leave_the_graph_as_it_was() -> None:
    graph = walk()
    before = graph.chi2()
    with pytest.raises(pg.ArgumentError):
        graph.add_observation(99, 10, [0, 0], np.eye(2))
    with pytest.raises(pg.ArgumentError):
        graph.add_point(10, [0, 0])
    with pytest.raises(pg.ArgumentError, match="robust"):
        pg.optimize(graph, robust="auto")
    with pytest.raises(pg.ArgumentError, match="certify"):
        pg.optimize(graph, certify=True)
    assert graph.chi2() == before


@pytest.mark.parametrize("way", ["nearest", "isotropic"])
def test_indefinite_information_is_refused_or_replaced(way: str, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "in.g2o"
    path.write_text("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\n"
                    "EDGE_SE2 0 1 1 0 0 100 200 0 100 0 400\nEDGE_SE2 1 2 1 0 0 9 0 0 9 0 9\n")
    with pytest.raises(pg.FileError, match=r"in\.g2o:4: .*indefinite.* 1 of 2 edges"):
        pg.PoseGraph.read(path)
    with pytest.warns(pg.Doubt, match="1 of 2 edges is indefinite"):
        graph = pg.PoseGraph.read(path, way)
    expected = {"nearest": [[150, 150, 0], [150, 150, 0], [0, 0, 400]],
                "isotropic": [[150, 0, 0], [0, 150, 0], [0, 0, 400]]}[way]
    assert graph.information[0] == pytest.approx(np.array(expected))
    assert graph.information[1] == pytest.approx(9 * np.eye(3))
