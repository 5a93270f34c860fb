"""Trajectories: arrays, files, tables."""

import pathlib
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from checks import wrong

STAMPS = np.array([1_000_000_000, 1_100_000_000, 1_250_000_000])


def poses() -> np.ndarray:
    matrices = np.tile(np.eye(4), (3, 1, 1))
    matrices[:, 0, 3] = [0, 3, 3]
    matrices[:, 1, 3] = [0, 0, 4]
    return matrices


def test_arrays_come_back_as_they_were_given() -> None:
    given = poses()
    given[1] = np.nan
    trajectory = pg.Trajectory.from_arrays(STAMPS, given)
    assert (len(trajectory), trajectory.posed, trajectory.path_length) == (3, 2, 5.0)
    np.testing.assert_array_equal(trajectory.stamps_ns, STAMPS)
    np.testing.assert_array_equal(trajectory.poses, given)


@pytest.mark.parametrize("format", [pg.TrajectoryFormat.TUM, pg.TrajectoryFormat.EUROC])
def test_files_with_times_are_read_as_written(
    format: pg.TrajectoryFormat, tmp_path: pathlib.Path
) -> None:
    file = tmp_path / "trajectory.txt"
    pg.Trajectory.from_arrays(STAMPS, poses()).write(file, format)
    again = pg.Trajectory.read(file)
    np.testing.assert_array_equal(again.stamps_ns, STAMPS)
    np.testing.assert_allclose(again.poses, poses(), atol=1e-9)
    assert again.has_times


def test_a_kitti_file_has_one_matrix_a_line(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "00.txt"
    pg.Trajectory.from_arrays(STAMPS, poses()).write(file, pg.TrajectoryFormat.KITTI)
    rows = np.loadtxt(file)
    np.testing.assert_allclose(rows.reshape(3, 3, 4), poses()[:, :3], atol=1e-9)
    again = pg.Trajectory.read(file)
    assert not again.has_times
    np.testing.assert_array_equal(again.stamps_ns, [0, 1, 2])


def test_a_pose_between_two_frames_is_interpolated() -> None:
    trajectory = pg.Trajectory.from_arrays(STAMPS, poses())
    between = trajectory.pose_at(1_050_000_000)
    assert between is not None
    np.testing.assert_allclose(between.translation, [1.5, 0, 0])
    assert trajectory.pose_at(999_999_999) is None


def test_the_table_has_a_row_a_frame() -> None:
    pytest.importorskip("pandas")
    given = poses()
    given[1] = np.nan
    table = pg.Trajectory.from_arrays(STAMPS, given).to_pandas()
    assert list(table.columns) == ["stamp_ns", "x", "y", "z", "qx", "qy", "qz", "qw"]
    assert table.x.isna().tolist() == [False, True, False]
    assert table.iloc[2][["x", "y", "qw"]].tolist() == [3.0, 4.0, 1.0]


def test_a_trajectory_is_a_sequence_of_its_frames() -> None:
    given = np.tile(np.eye(4), (6, 1, 1))
    given[:, 0, 3] = range(6)
    given[4] = np.nan
    stamps = 10**9 * np.arange(6)
    trajectory = pg.Trajectory.from_arrays(stamps, given)
    for i in (0, -1, 5, -6, np.int64(2), np.uint8(3)):
        frame = trajectory[i]
        assert frame.stamp_ns == stamps[i]
        assert frame.T_world_body == pg.SE3(given[i])
    assert trajectory[4].T_world_body is None and "lost" in repr(trajectory[4])
    assert [frame.stamp_ns for frame in trajectory] == stamps.tolist()
    assert list(trajectory) == [trajectory[i] for i in range(6)]
    assert list(reversed(trajectory))[0] == trajectory[-1] and trajectory[2] in trajectory
    for which in (slice(None), slice(1, 4), slice(None, None, 2), slice(-2, 100), slice(4, 2)):
        part = trajectory[which]
        np.testing.assert_array_equal(part.stamps_ns, stamps[which])
        np.testing.assert_array_equal(part.poses, given[which])
        assert isinstance(part, pg.Trajectory) and part.has_times
    assert trajectory[:] == trajectory
    for beyond in (6, -7, 10**30):
        with pytest.raises(IndexError):
            trajectory[beyond]
    with pytest.raises(TypeError):
        trajectory[wrong("1")]
    with pytest.raises(pg.ArgumentError, match="slice: its step must be positive"):
        trajectory[::-1]


@pytest.mark.parametrize("unit", ["ns", "us", "ms", "s"])
def test_stamps_may_be_times_of_numpy(unit: str) -> None:
    times = (np.datetime64("2026-11-28T10:00:00") + np.arange(4)).astype(f"datetime64[{unit}]")
    poses = np.tile(np.eye(4), (4, 1, 1))
    made = pg.Trajectory.from_arrays(times, poses)
    assert made.stamps_ns.tolist() == times.astype("datetime64[ns]").astype(np.int64).tolist()
    times[2] = np.datetime64("NaT")
    with pytest.raises(pg.ArgumentError, match="stamps_ns: a value is no time"):
        pg.Trajectory.from_arrays(times, poses)


@pytest.mark.parametrize("first", [np.datetime64("3000-01-01"), np.datetime64("1000-01-01"),
                                   np.datetime64(3, "ps")])
def test_times_that_are_no_nanoseconds_are_refused(first: np.datetime64) -> None:
    with pytest.raises(pg.ArgumentError, match="stamps_ns: a time is not in nanoseconds, or not"):
        pg.Trajectory.from_arrays(first + np.arange(4), np.tile(np.eye(4), (4, 1, 1)))


class Rotations:
    """What rotations and motions of scipy offer."""

    def __init__(self, matrices: np.ndarray) -> None:
        self._matrices = matrices

    def as_matrix(self) -> np.ndarray:
        return self._matrices

    def as_quat(self) -> np.ndarray:
        return pg.SE3(np.block([[self._matrices, np.zeros((3, 1))],
                                [np.zeros((1, 3)), np.ones((1, 1))]])).quaternion_xyzw


def test_motions_of_scipy_are_matrices_and_its_rotations_quaternions() -> None:
    poses = [pg.SE3.exp([i, 1, 2, 0.1 * i, 0.2, 0.3]) for i in range(3)]
    motions: Any = Rotations(np.stack([pose.matrix() for pose in poses]))
    made = pg.Trajectory.from_arrays(np.arange(3), motions)
    np.testing.assert_allclose(made.poses, [pose.matrix() for pose in poses], atol=1e-12)
    rotation: Any = Rotations(poses[1].rotation)
    np.testing.assert_allclose(pg.SE3.from_quaternion_xyzw(rotation, [1, 1, 2]).matrix()[:3, :3],
                               poses[1].rotation, atol=1e-12)
    np.testing.assert_allclose(pg.SO3(rotation).matrix(), poses[1].rotation, atol=1e-12)
    with pytest.raises(pg.ArgumentError, match="quaternion: an array of float64, 4"):
        pg.SE3.from_quaternion_wxyz(rotation, [0, 0, 0])
