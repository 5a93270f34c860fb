"""Trajectories: arrays, files, tables."""

import pathlib

import numpy as np
import pytest

import placegraph as pg

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
