"""Pose graphs: arrays, files, networkx, optimization and covariances."""

import copy
import json
import os
import pathlib
import signal
import subprocess
import types

import numpy as np
import pytest

import placegraph as pg
from placegraph import graphs
from graph_samples import one_sign, plane, ring, se3_of_row


def test_arrays_come_back_as_they_were_given() -> None:
    graph = plane()
    assert graph.kind == "SE2" and len(graph) == 5 and graph.constraints == 5
    again = pg.PoseGraph.from_arrays(graph.ids, graph.poses, graph.edges, graph.measurements,
                                     graph.information, graph.sources, [0, 3])
    np.testing.assert_array_equal(again.poses, graph.poses)
    np.testing.assert_array_equal(again.edges, [[0, 1], [1, 2], [2, 3], [3, 4], [0, 4]])
    np.testing.assert_array_equal(again.measurements, graph.measurements)
    assert again.sources == ("odometry",) * 4 + ("loop",)
    assert again.fixed.tolist() == [0, 3] and graph.fixed.size == 0
    again.set_poses(again.poses + 1.0)
    np.testing.assert_array_equal(again.poses, graph.poses + 1)
    assert copy.copy(again).chi2() == again.chi2() and "5 nodes" in repr(again)


def matrices_of(rows: np.ndarray) -> np.ndarray:
    if rows.shape[1] == 3:
        return np.stack([pg.SE2(*row).matrix() for row in rows])
    return np.stack([se3_of_row(row).matrix() for row in rows])


@pytest.mark.parametrize("graph", [ring(noise=0.05), plane()], ids=["space", "plane"])
def test_poses_and_measurements_may_be_matrices(graph: pg.PoseGraph) -> None:
    made = pg.PoseGraph.from_arrays(graph.ids, matrices_of(graph.poses), graph.edges,
                                    matrices_of(graph.measurements), graph.information,
                                    graph.sources)
    assert made.kind == graph.kind
    np.testing.assert_allclose(one_sign(made.poses), one_sign(graph.poses), atol=1e-14)
    np.testing.assert_allclose(one_sign(made.measurements), one_sign(graph.measurements),
                               atol=1e-14)
    assert made.chi2() == pytest.approx(graph.chi2(), rel=1e-9)
    added = pg.PoseGraph()
    for node, matrix in zip(graph.ids.tolist(), matrices_of(graph.poses)):
        added.add_node(node, matrix)
    for (begin, end), matrix, information, source in zip(
            graph.edges.tolist(), matrices_of(graph.measurements), graph.information,
            graph.sources):
        added.add_edge(begin, end, matrix.tolist(), information, source)
    assert added == made
    moved = made.copy()
    moved.set_poses(matrices_of(graph.poses)[::-1])
    np.testing.assert_array_equal(moved.poses, made.poses[::-1])


def test_one_information_is_that_of_all_edges() -> None:
    graph = ring()
    information = np.diag([1.0, 2, 3, 4, 5, 6])
    made = pg.PoseGraph.from_arrays(graph.ids, graph.poses, graph.edges, graph.measurements,
                                    information)
    np.testing.assert_array_equal(made.information, np.tile(information, (len(graph.edges), 1, 1)))


@pytest.mark.parametrize("dtype", [np.uint64, np.int32, np.uint8, ">i8", ">u8"])
def test_ids_may_be_of_any_integer_type(dtype: str) -> None:
    graph = plane()
    made = pg.PoseGraph.from_arrays(graph.ids.astype(dtype), graph.poses,
                                    graph.edges.astype(dtype), graph.measurements,
                                    graph.information)
    assert made == graph


def test_keys_of_symbols_are_ids() -> None:
    keys = (np.uint64(ord("x")) << np.uint64(56)) + np.arange(3, dtype=np.uint64)
    graph = plane(3)
    made = pg.PoseGraph.from_arrays(keys, graph.poses, keys[graph.edges], graph.measurements,
                                    np.eye(3))
    assert made.ids.tolist() == keys.tolist()


def test_chi2_is_the_sum_of_squared_logarithms() -> None:
    graph = ring(noise=0.05)
    poses = [se3_of_row(row) for row in graph.poses]
    total = 0.0
    for (begin, end), row, information in zip(graph.edges, graph.measurements, graph.information):
        error = (se3_of_row(row).inverse() * poses[begin].inverse() * poses[end]).log()
        total += error @ information @ error
    assert graph.chi2() == pytest.approx(total, rel=1e-12)
    assert graph.chi2("quaternion") < graph.chi2()  # half the angle


def test_files_and_copies_keep_everything(tmp_path: pathlib.Path) -> None:
    graph = ring(noise=0.02)
    graph.add_position(3, [1.0, 2, 3], np.eye(3))
    path = tmp_path / "ring.g2o"
    with pytest.raises(ValueError):
        graph.write_g2o(str(path))  # g2o has measured positions in the plane alone
    assert not path.exists()
    graph = graph.without([graph.constraints - 1])
    graph.write_g2o(str(path))
    again = pg.PoseGraph.read(str(path))
    np.testing.assert_allclose(again.poses, graph.poses, atol=1e-15)
    np.testing.assert_allclose(again.information, graph.information)
    assert again.chi2() == pytest.approx(graph.chi2(), rel=1e-12)


def test_toro_and_isam_are_read(tmp_path: pathlib.Path) -> None:
    (tmp_path / "toro.graph").write_text(
        "VERTEX2 0 0 0 0\nVERTEX2 1 1.1 0 0\nEDGE2 0 1 1 0 0 4 0 4 9 0 0\n")
    (tmp_path / "isam.txt").write_text("ODOMETRY 0 1 1 0 0 2 0 0 2 0 3\n")
    for name in ("toro.graph", "isam.txt"):
        graph = pg.PoseGraph.read(str(tmp_path / name))
        np.testing.assert_allclose(graph.information, [np.diag([4.0, 4, 9])])


def test_networkx_both_ways() -> None:
    networkx = pytest.importorskip("networkx")
    graph = ring(noise=0.02)
    graph.add_position(3, [1.0, 2, 3], 2 * np.eye(3), [0.1, 0, 0])
    made = graphs.to_networkx(graph)
    assert isinstance(made, networkx.MultiDiGraph) and made.number_of_edges() == len(graph.edges)
    again = graphs.from_networkx(made)
    np.testing.assert_allclose(again.poses, graph.poses, atol=1e-15)
    np.testing.assert_array_equal(again.position_information, [2 * np.eye(3)])
    np.testing.assert_array_equal(again.lever_arms, [[0.1, 0, 0]])
    order = {tuple(edge): i for i, edge in enumerate(again.edges.tolist())}
    for edge, row, source in zip(graph.edges.tolist(), graph.measurements, graph.sources):
        np.testing.assert_allclose(again.measurements[order[tuple(edge)]], row, atol=1e-15)
        assert again.sources[order[tuple(edge)]] == source


def test_integers_of_numpy_are_nodes_of_networkx() -> None:
    networkx = pytest.importorskip("networkx")
    made = networkx.MultiDiGraph()
    for i in np.arange(3):
        made.add_node(i, pose=pg.SE2(float(i), 0, 0), fixed=np.bool_(i == 1))
    made.add_edge(np.int64(0), np.int32(2), measurement=pg.SE2(2, 0, 0), information=np.eye(3))
    graph = pg.from_networkx(made)
    assert graph.ids.tolist() == [0, 1, 2] and graph.edges.tolist() == [[0, 2]]
    assert graph.fixed.tolist() == [1]
    assert pg.to_networkx(graph).nodes[1]["fixed"]


def test_optimization_reaches_the_least_squares_of_a_line() -> None:
    # Four steps of 1 and a measurement of 4.2 over them: 0.2 spread over five edges.
    report = pg.optimize(plane())
    assert report.ok and report.reason == ""
    assert report.chi2_final == pytest.approx(0.2**2 / 5, rel=1e-9)
    assert report.chi2_final == pytest.approx(report.chi2_by_constraint.sum())
    np.testing.assert_allclose(report.graph.poses[:, 0], 1.04 * np.arange(5), atol=1e-6)
    assert report.chi2_initial == pytest.approx(plane().chi2())
    assert report.certificate is None and report.rejected == () and report.free_directions == 0


def test_false_loops_are_rejected_with_reasons_and_the_rest_is_certified() -> None:
    graph = ring(40, noise=0.01, false_loops=4)
    report = pg.optimize(graph, robust="auto", certify=True)
    false = list(range(graph.constraints - 4, graph.constraints))
    assert [edge.constraint for edge in report.rejected] == false
    assert all(edge.reason and edge.chi2 > 100 for edge in report.rejected)
    assert report.loops_judged
    certificate = report.certificate
    assert certificate is not None and certificate.certified
    assert certificate.lower_bound <= certificate.cost <= certificate.cost_of_estimate + 1e-9
    rejected = [edge.constraint for edge in report.rejected]
    assert report.chi2_kept == pytest.approx(np.delete(report.chi2_by_constraint, rejected).sum())
    assert "4 constraints rejected" in repr(report) and "certified" in repr(report)
    clean = pg.optimize(graph.without(false))
    np.testing.assert_allclose(report.graph.poses, clean.graph.poses, atol=1e-6)


def test_free_directions_are_told() -> None:
    graph = plane(3)
    information = graph.information.copy()
    information[:, 2, 2] = 0
    free = pg.PoseGraph.from_arrays(graph.ids, graph.poses, graph.edges[:2],
                                    graph.measurements[:2], information[:2])
    report = pg.optimize(free)
    assert report.free_directions > 0 and 2 in report.free_nodes
    with pytest.raises(pg.Error, match="undetermined"):
        pg.marginal_covariances(free)


def test_measured_positions_place_the_graph() -> None:
    graph = ring(noise=0.02)
    shift = np.array([10.0, -3, 2])
    for i, row in enumerate(graph.poses):
        graph.add_position(i, row[:3] + shift, 1e4 * np.eye(3))
    report = pg.optimize(graph)
    moved = report.graph.poses[:, :3] - graph.poses[:, :3]
    np.testing.assert_allclose(moved.mean(axis=0), shift, atol=0.02)
    np.testing.assert_array_equal(graph.position_nodes, np.arange(12))


def dense_covariance(graph: pg.PoseGraph) -> np.ndarray:
    """The inverse of the normal matrix by central differences; node 0 is held."""
    poses = [se3_of_row(row) for row in graph.poses]
    measured = [se3_of_row(row) for row in graph.measurements]
    roots = [np.linalg.cholesky(information).T for information in graph.information]

    def residuals(moved: list[pg.SE3]) -> np.ndarray:
        rows = zip(graph.edges, measured, roots)
        return np.concatenate([root @ (T.inverse() * moved[i].inverse() * moved[j]).log()
                               for (i, j), T, root in rows])

    columns = []
    for node in range(1, len(poses)):
        for axis in range(6):
            step = 1e-5 * np.eye(6)[axis]
            ahead, behind = list(poses), list(poses)
            ahead[node], behind[node] = poses[node].plus(step), poses[node].plus(-step)
            columns.append((residuals(ahead) - residuals(behind)) / 2e-5)
    J = np.array(columns).T
    return np.linalg.inv(J.T @ J)


def test_marginal_covariances_are_blocks_of_the_dense_inverse() -> None:
    graph = pg.optimize(ring(8, noise=0.02)).graph
    dense = dense_covariance(graph)
    every = pg.marginal_covariances(graph)
    assert every.shape == (8, 6, 6) and not every[0].any()
    for i in range(1, 8):
        block = dense[6 * i - 6:6 * i, 6 * i - 6:6 * i]
        np.testing.assert_allclose(every[i], block, atol=1e-8 * np.abs(dense).max())
    np.testing.assert_allclose(pg.marginal_covariances(graph, [5, 2]), every[[5, 2]], atol=1e-12)
    joint = pg.PoseMarginals(graph).joint_covariance([5, 2])
    np.testing.assert_allclose(joint[:6, 6:], dense[24:30, 6:12], atol=1e-8 * np.abs(dense).max())


def test_relative_covariances_follow_from_the_joint_ones() -> None:
    graph = pg.optimize(ring(8, noise=0.02)).graph
    marginals = pg.PoseMarginals(graph)
    joint = np.asarray(marginals.joint_covariance([2, 5]))
    poses = [se3_of_row(row) for row in graph.poses]
    J = np.hstack([-(poses[5].inverse() * poses[2]).adjoint(), np.eye(6)])
    expected = J @ joint @ J.T
    np.testing.assert_allclose(marginals.relative_covariance(2, 5), expected, atol=1e-12)
    edges = marginals.edge_covariances()
    k = graph.edges.tolist().index([2, 3])
    np.testing.assert_allclose(edges[k], marginals.relative_covariance(2, 3), atol=1e-12)


def test_bits_are_those_of_the_program(
    research_data: pathlib.Path, tmp_path: pathlib.Path
) -> None:
    program = pathlib.Path(os.environ.get("PLACEGRAPH", "absent"))
    path = research_data / "posegraphs" / "M3500.g2o"
    if not program.is_file() or not path.is_file():
        pytest.skip(f"PLACEGRAPH={program} or {path} is absent")
    out = tmp_path / "out.g2o"
    told = subprocess.run([program, "optimize", path, "-o", out, "--json", "--quiet"],
                          check=True, capture_output=True, text=True)
    report = pg.optimize(pg.PoseGraph.read(str(path)))
    assert report.chi2_final == json.loads(told.stdout)["chi2_log"]
    written = tmp_path / "python.g2o"
    report.graph.write_g2o(str(written))
    assert written.read_bytes() == out.read_bytes()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there are no timers of signals")
def test_a_signal_ends_the_optimization() -> None:
    graph = ring(1500, noise=0.05, false_loops=30)

    def handler(number: int, frame: types.FrameType | None) -> None:
        raise TimeoutError("of the handler")

    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with pytest.raises(TimeoutError, match="of the handler") as raised:
            pg.optimize(graph, robust="gnc")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert raised.traceback[-2].name == "optimize"  # it was waiting in the library
