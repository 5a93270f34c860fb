"""Offsets of body and time: what was put in is found, and removed before an evaluation."""

import numpy as np
import pytest

import placegraph as pg


def drive(count: int = 400) -> pg.Trajectory:
    """A motion with turns about every axis, 10 poses a second."""
    poses = [np.eye(4)]
    for i in range(count - 1):
        turn = [0.05 * np.sin(0.11 * i), 0.06 * np.cos(0.07 * i), 0.04 * np.sin(0.05 * i + 1)]
        poses.append(poses[-1] @ pg.SE3.exp([1 + 0.5 * np.sin(0.09 * i), 0, 0, *turn]).matrix())
    return pg.Trajectory.from_arrays(np.arange(count, dtype=np.int64) * 100_000_000, np.stack(poses))


def test_a_lever_arm_a_turn_and_a_time_are_found_and_removed() -> None:
    truth = drive()
    offset = pg.SE3.exp([0.3, -0.2, 0.5, 0.1, 0.2, -0.1]).matrix()
    moved = truth.poses @ np.linalg.inv(offset)
    estimate = pg.Trajectory.from_arrays(truth.stamps_ns - 40_000_000, moved)
    found = pg.estimate_offsets(truth, estimate)
    assert found.ok and not found.free
    assert found.time_s == pytest.approx(0.04, abs=1e-3)
    np.testing.assert_allclose(found.T_estimate_truth.matrix(), offset, atol=2e-3)
    assert found.lever_arm_deviation_m.shape == (3,)
    error = pg.evaluate(truth, pg.with_offsets(estimate, found)).ape_m
    assert error is not None and error.rmse < 1e-2
    assert "lever" in repr(found)


def test_what_the_motion_does_not_show_has_a_reason() -> None:
    poses = np.tile(np.eye(4), (50, 1, 1))
    still = pg.Trajectory.from_arrays(np.arange(50, dtype=np.int64) * 100_000_000, poses)
    found = pg.estimate_offsets(still, still)
    assert not found.ok and found.reason
    with pytest.raises(pg.ArgumentError, match="neither body nor time"):
        pg.estimate_offsets(drive(), drive(), body=False, time=False)
