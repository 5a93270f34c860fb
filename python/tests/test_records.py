"""Records of runs and their judgement: the same answers as those of the command."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import placegraph as pg


def drive(noise_m: float = 0.0, seed: int = 0, frames: int = 300) -> pg.Trajectory:
    """A turning drive of 1 m a frame, with white noise of the positions."""
    poses = [np.eye(4)]
    for _ in range(frames - 1):
        poses.append(poses[-1] @ pg.SE3.exp([1, 0, 0, 0, 0, 0.02]).matrix())
    stacked = np.stack(poses)
    stacked[:, :3, 3] += noise_m * np.random.default_rng(seed).standard_normal((frames, 3))
    return pg.Trajectory.from_arrays(np.arange(frames, dtype=np.int64) * 100_000_000, stacked)


def runs(noise_m: float, count: int, seed: int) -> list[pg.Trajectory]:
    return [drive(noise_m, seed + i) for i in range(count)]


RULES = ["* | ate_rmse_m | significant", "* | * | info"]


def test_a_worse_system_regressed_and_an_equal_one_did_not() -> None:
    before = pg.record(drive(), runs(0.1, 6, 10), name="town")
    for noise_m, exit_code in ((0.1, 0), (0.2, 1), (0.05, 0)):
        judged = pg.gate(before, pg.record(drive(), runs(noise_m, 6, 50), name="town"), rules=RULES)
        assert judged.exit_code == exit_code and bool(judged) == (exit_code == 0) == judged.ok
    worse = pg.gate(before, pg.record(drive(), runs(0.2, 6, 50), name="town"), rules=RULES)
    assert worse.figures.iloc[0].verdict == "regressed"
    assert "ate_rmse_m" in worse.sentence and worse.sentence in repr(worse)
    assert "<testsuite" in worse.to_junit() and "**regressed**" in worse.to_markdown()


def test_too_few_runs_cannot_be_judged_and_say_how_many_are_needed() -> None:
    before = pg.record(drive(), runs(0.1, 6, 10))
    judged = pg.gate(before, pg.record(drive(), runs(0.1, 1, 30)), rules=RULES)
    assert judged.exit_code == 2 and not judged
    assert judged.figures.iloc[0].runs_needed >= 5


def test_runs_are_added_behind_one_another_and_files_are_records(tmp_path: pathlib.Path) -> None:
    one = pg.record(drive(), runs(0.1, 2, 10), name="town", programs=["mine 1"])
    both = one.with_runs(pg.record(drive(), runs(0.1, 3, 20), name="town"))
    assert len(both.values("town", "ate_rmse_m")) == 5 == both.figures.runs.iloc[0]
    assert both.programs[0] == "mine 1"
    both.save(tmp_path / "b.json")
    assert pg.read_record(tmp_path / "b.json") == both
    with pytest.raises(pg.ArgumentError, match="force=True"):
        both.save(tmp_path / "b.json")
    assert pg.gate(tmp_path / "b.json", [one, one]).exit_code in (0, 1)
    other = pg.record(drive(frames=200), [drive(frames=200)], name="town")
    assert pg.gate(both, other).exit_code == 2
    with pytest.raises(pg.ArgumentError, match="the truth is another one"):
        both.with_runs(other)


def test_a_run_without_figures_is_a_failed_run() -> None:
    record = pg.record(drive(), {"good": drive(0.1), "lost": pg.Trajectory()}, name="town")
    assert record.values("town", "ate_rmse_m")[1] is None
    assert [line.split(":")[0] for line in record.failures["town"]] == ["lost"]


def test_both_doors_write_the_same_record(tmp_path: pathlib.Path) -> None:
    names = ["truth.tum", "one.tum", "two.tum"]
    for name, poses in zip(names, (drive(), drive(0.1, 1), drive(0.2, 2))):
        poses.write(tmp_path / name, pg.TrajectoryFormat.TUM)
    paths = [str(tmp_path / name) for name in names]
    subprocess.run([os.environ["PLACEGRAPH"], "eval", "record", *paths, "--name", "town", "--out",
                    str(tmp_path / "record.json")], check=True, capture_output=True)
    here = pg.record(paths[0], paths[1:], name="town")
    assert here == pg.read_record(tmp_path / "record.json")


def test_intervals_are_of_relative_figures_and_of_repeated_runs() -> None:
    estimates = {f"run {i}": each for i, each in enumerate(runs(0.1, 6, 10))}
    judged = pg.compare(drive(), estimates, deltas="10f")
    of_one = judged["run 0"].intervals()
    assert of_one.loc["rpe_trans_m"].low < of_one.loc["rpe_trans_m"].estimate
    assert np.isnan(of_one.loc["rpe_10f_trans_m"].low) and of_one.loc["rpe_10f_trans_m"].reason
    assert of_one.loc["ate_rmse_m"].reason == "one run"
    over = judged.over_runs()
    assert over.loc["ate_rmse_m"].low < over.loc["ate_rmse_m"].estimate < over.loc["ate_rmse_m"].high
    wider = judged.over_runs(level=0.99)
    assert wider.loc["ate_rmse_m"].high > over.loc["ate_rmse_m"].high


def test_differences_name_the_worse_estimate() -> None:
    judged = pg.compare(drive(), {"A": drive(0.1, 1), "B": drive(0.2, 2)})
    row = judged.differences().set_index("figure").loc["rpe_trans_m"]
    assert row["name"] == "B" and row.difference == "worse" and row.low > 1
    assert row.sentence.startswith("B is ")
    equal = pg.compare(drive(), {"A": drive(0.1, 1), "B": drive(0.1, 2)}).differences()
    assert set(equal.set_index("figure").loc[["rpe_trans_m"]].difference) == {"none"}
