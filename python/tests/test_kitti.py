"""KITTI's benchmark: against the devkit's definitions in numpy and the program's output."""

import os
import pathlib
import subprocess

import matplotlib
import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import _core

matplotlib.use("agg")
Array = NDArray[np.float64]


def straight(frames: int, scale: float) -> pg.Trajectory:
    """A metre a frame along z, scaled."""
    poses = np.tile(np.eye(4), (frames, 1, 1))
    poses[:, 2, 3] = scale * np.arange(frames)
    return pg.Trajectory.from_arrays(np.arange(frames, dtype=np.int64), poses)


def write(folder: pathlib.Path, name: str, poses: pg.Trajectory) -> None:
    folder.mkdir(exist_ok=True)
    poses.write(folder / name, pg.TrajectoryFormat.KITTI)


@pytest.fixture
def folders(tmp_path: pathlib.Path) -> list[pathlib.Path]:
    """A truth of two sequences, and estimates that are one and two percent too long."""
    for name, scale in (("truth", 1.0), ("one", 1.01), ("two", 1.02)):
        write(tmp_path / name, "03.txt", straight(301, scale))
        write(tmp_path / name, "04.txt", straight(201, scale))
    return [tmp_path / name for name in ("truth", "one", "two")]


def test_figures_are_those_of_a_straight_line(folders: list[pathlib.Path]) -> None:
    judged = pg.evaluate_kitti(folders[0], folders[1:])
    assert judged and judged.ok and len(judged.faults) == 0
    # The ends lie at metre 101 and 201: 20 and 10 segments in 03, 10 of 100 m in 04.
    assert judged.table.loc[("one", "03"), "segments"] == 30
    assert judged.table.loc[("one", "04"), "segments"] == 10
    mean = (30 * 1.01 + 10 * 1.005) / 40
    assert judged.table.loc[("one", "mean"), "t_rel_percent"] == pytest.approx(mean, rel=1e-9)
    assert judged.table.loc[("two", "mean"), "t_rel_percent"] == pytest.approx(2 * mean, rel=1e-9)
    lengths = judged.lengths.query("system == 'two' and sequence == '03'")
    assert list(lengths["length_m"]) == [100, 200]
    np.testing.assert_allclose(lengths["t_percent"], [2.02, 2.01])
    assert set(judged.speeds["speed_m_per_s"]) == {8, 10}


def test_it_is_what_the_program_prints(program: str, folders: list[pathlib.Path]) -> None:
    names = [str(folder) for folder in folders]
    judged = pg.evaluate_kitti(names[0], names[1:])
    printed = subprocess.run([program, "eval", "kitti", *names, "--json"], check=True,
                             capture_output=True, text=True)
    assert judged.to_json() == printed.stdout
    assert repr(judged) in subprocess.run([program, "eval", "kitti", *names], check=True,
                                          capture_output=True, text=True).stdout
    assert judged.to_csv().startswith("system,sequence") and "<pre>" in judged._repr_html_()


def test_faults_are_warned_of(folders: list[pathlib.Path]) -> None:
    (folders[1] / "04.txt").write_text("1 0 0\n")
    with pytest.warns(pg.Doubt, match="04.txt:1: 3 numbers, not 12") as warned:
        judged = pg.evaluate_kitti(folders[0], folders[1])
    assert {each.filename for each in warned} == {__file__}
    assert not judged.ok and list(judged.faults["line"]) == [1, 0]
    assert judged.table["t_rel_percent"].isna()[("one", "mean")]
    with pytest.raises(pg.ArgumentError, match="faults"):
        judged.write(folders[0] / "out")
    assert pg.evaluate_kitti(folders[0], folders[1], sequences=["03"]).ok


def test_files_and_pictures(folders: list[pathlib.Path], tmp_path: pathlib.Path) -> None:
    judged = pg.evaluate_kitti(folders[0], folders[1:])
    judged.write(tmp_path / "out", format="svg")
    assert (tmp_path / "out" / "one" / "stats.txt").read_text().split()[1] == "0.000000"
    for kind in _core.kitti_plots():
        figure = judged.plot("03", kind)
        assert len(figure.axes) == 1
        folder, name = ("plot_path", "03") if kind == "path" else ("plot_error", f"03_{kind}")
        text = (tmp_path / "out" / folder / f"{name}.svg").read_text()
        assert judged.picture("03", kind).to_svg() == text
    with pytest.raises(pg.ArgumentError, match="force=True writes"):
        judged.write(tmp_path / "out")
    with pytest.raises(pg.ArgumentError, match="nothing to draw"):
        judged.picture("avg", "path")
    assert os.path.exists(tmp_path / "out" / "plot_error" / "avg_rs.svg")
