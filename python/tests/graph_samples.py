"""Pose graphs that tests share."""

import numpy as np

import placegraph as pg


def ring(count: int = 12, *, noise: float = 0.0, false_loops: int = 0) -> pg.PoseGraph:
    """Poses on a circle in space, measured to the next, the one after and the one opposite."""
    random = np.random.default_rng(5)
    turn = pg.SE3.exp([1.0, 0.0, 0.02, 0.0, 0.0, 2 * np.pi / count])
    poses = [pg.SE3()]
    for _ in range(count - 1):
        poses.append(poses[-1] * turn)
    graph = pg.PoseGraph()
    for i, pose in enumerate(poses):
        graph.add_node(i, pose.plus(noise * random.normal(size=6)))
    pairs = [(i, i + 1) for i in range(count - 1)]
    pairs += [(i, i + 2) for i in range(count - 2)] + [(0, count - 1), (1, count - 2)]
    for begin, end in pairs:
        measured = (poses[begin].inverse() * poses[end]).plus(noise * random.normal(size=6))
        source = "odometry" if end == begin + 1 else "loop"
        graph.add_edge(begin, end, measured, np.diag([100.0, 100, 100, 400, 400, 400]), source)
    for i in range(false_loops):
        graph.add_edge(i, count // 2 + i, pg.SE3(), 100 * np.eye(6), "loop")
    return graph


def plane(rows: int = 5) -> pg.PoseGraph:
    ids = np.arange(rows)
    poses = np.column_stack([1.1 * ids, 0.1 * ids, 0 * ids])
    edges = np.array([[i, i + 1] for i in range(rows - 1)] + [[0, rows - 1]])
    measured = np.array([[1.0, 0, 0]] * (rows - 1) + [[rows - 0.8, 0, 0]])
    return pg.PoseGraph.from_arrays(ids, poses, edges, measured, np.tile(np.eye(3), (rows, 1, 1)))


def se3_of_row(row: np.ndarray) -> pg.SE3:
    return pg.SE3.from_quaternion_xyzw(row[3:], row[:3])


def one_sign(rows: np.ndarray) -> np.ndarray:
    """Rows of poses whose quaternions have a positive w: both signs are the same rotation."""
    if rows.shape[1] == 3:
        return rows
    signs = np.where(rows[:, 6:7] < 0, -1, 1)
    return np.hstack([rows[:, :3], signs * rows[:, 3:7]])
