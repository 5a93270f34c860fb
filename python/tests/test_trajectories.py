"""Trajectories of tables, arrays and files: repeated stamps, filters, what they say of themselves."""

from __future__ import annotations

import pathlib

import numpy as np
import pandas
import pytest
from numpy.typing import NDArray

import placegraph as pg

STEP_NS = 100_000_000
BEGIN_NS = 1_600_000_000_000_000_000


def poses(count: int) -> NDArray[np.float64]:
    """A camera that drives along a circle and looks forward (z)."""
    angle = 0.02 * np.arange(count)
    T = np.tile(np.eye(4), (count, 1, 1))
    T[:, 0, 0] = T[:, 2, 2] = np.cos(angle)
    T[:, 0, 2], T[:, 2, 0] = np.sin(angle), -np.sin(angle)
    T[:, :3, 3] = 50 * np.stack([1 - np.cos(angle), 0 * angle, np.sin(angle)], axis=1)
    return T


def drive(count: int = 100) -> pg.Trajectory:
    return pg.Trajectory.from_arrays(BEGIN_NS + STEP_NS * np.arange(count), poses(count))


def test_of_rows_with_one_stamp_the_first_is_kept() -> None:
    stamps = np.array([0, 1, 1, 2]) * STEP_NS
    with pytest.warns(pg.Doubt, match="stamps_ns: row 2: the stamp stands twice"):
        trajectory = pg.Trajectory.from_arrays(stamps, poses(4))
    assert len(trajectory) == 3 and len(trajectory.warnings) == 1
    np.testing.assert_array_equal(trajectory.poses[1], poses(4)[1])
    with pytest.raises(pg.ArgumentError, match="row 1 goes back"):
        pg.Trajectory.from_arrays(stamps[::-1], poses(4))
    with pytest.raises(pg.ArgumentError, match="3 of 4 rows have the stamp"):
        pg.Trajectory.from_arrays(np.zeros(4, np.int64), poses(4))


def test_a_file_with_a_stamp_twice_is_read_and_judged_with_a_warning(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "truth.tum"
    drive().write(path)
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:50] + [lines[49]] + lines[50:]) + "\n")
    with pytest.warns(pg.Doubt, match="truth.tum:51: the stamp stands twice"):
        assert len(pg.Trajectory.read(path)) == 100
    with pytest.warns(pg.Doubt, match="truth.tum:51"):
        result = pg.evaluate(path, drive())
    assert result["ate_rmse_m"] == pytest.approx(0, abs=1e-6)


def test_tables_of_pandas_are_trajectories() -> None:
    trajectory = drive()
    table = trajectory.to_pandas()
    same = pg.Trajectory.from_pandas(table)
    np.testing.assert_array_equal(same.stamps_ns, trajectory.stamps_ns)
    np.testing.assert_allclose(same.poses, trajectory.poses, atol=1e-12)
    # Times as an index of pandas, and as seconds, as evo has them.
    columns = table.drop(columns="stamp_ns")
    for index in (pandas.to_datetime(table["stamp_ns"]), table["stamp_ns"].to_numpy() * 1e-9):
        indexed = columns.set_index(pandas.Index(index, name=None))
        again = pg.Trajectory.from_pandas(indexed)
        assert again.has_times
        np.testing.assert_allclose(again.stamps_ns, trajectory.stamps_ns, atol=1000)
    lost = table.copy()
    lost.loc[3, ["x", "y", "z", "qx", "qy", "qz", "qw"]] = np.nan
    assert pg.Trajectory.from_pandas(lost).posed == 99
    assert pg.evaluate(table, lost)["coverage"] == pytest.approx(0.99)
    with pytest.raises(pg.FileError, match="^table"):
        pg.Trajectory.from_pandas(table.rename(columns={"x": "east"}))


def test_filters_are_those_of_the_program(program: str, tmp_path: pathlib.Path) -> None:
    import subprocess

    source, out = tmp_path / "in.tum", tmp_path / "out.tum"
    drive().write(source)
    chain = "crop 1:5; downsample 0.5s; axes both camera:flu; scale 2"
    subprocess.run([program, "graph", "convert", str(source), str(out), "--apply", chain], check=True)
    expected = pg.Trajectory.read(out)
    found = pg.Trajectory.read(source).apply(chain)
    np.testing.assert_array_equal(found.stamps_ns, expected.stamps_ns)
    np.testing.assert_allclose(found.poses, expected.poses, atol=1e-8)
    with pytest.raises(pg.ArgumentError, match=r"step 2 \(turn\)"):
        drive().apply("invert; turn")
    with pytest.raises(pg.NoResult, match="leaves no pose"):
        drive().apply("crop 99:")
    assert any(form.startswith("crop") for form, _ in pg.filter_steps())


def test_parts_are_merged_again() -> None:
    trajectory = drive()
    parts = trajectory.split(2.5)
    assert [len(part) for part in parts] == [25, 25, 25, 25]
    assert pg.merge_trajectories(parts[::-1]) == trajectory
    assert len(trajectory[:40].split()) == 1
    with pytest.raises(pg.ArgumentError, match="before the end of an earlier one"):
        pg.merge_trajectories([trajectory, trajectory])
    assert len(pg.merge_trajectories([trajectory, trajectory], keep_first=True)) == 100


def test_a_trajectory_describes_itself() -> None:
    info = pg.trajectory_info(drive())
    assert info.frames == 100 and info.posed == 100
    assert info.speed.median == pytest.approx(10, rel=1e-3)
    assert info.spacing_s.median == pytest.approx(0.1)
    assert info.plane.ok and info.plane.axis == "y"
    assert info.forward.ok and info.forward.axis == "+z"
    assert info.gaps == () and info.stops == () and info.jumps == ()
    assert pg.trajectory_info(drive().to_pandas()).frames == 100
    still = pg.Trajectory.from_arrays(STEP_NS * np.arange(20), np.tile(np.eye(4), (20, 1, 1)))
    assert not pg.trajectory_info(still).plane.ok
    assert "does not move" in pg.trajectory_info(still).plane.reason
