"""Tables of systems on sequences, and result archives of evo."""

import io
import json
import pathlib
import zipfile

import numpy as np
import pytest

import placegraph as pg


def drive(off_m: float) -> pg.Trajectory:
    poses = np.stack([pg.SE3.exp([0, 0, 0, 0, 0.1 * i, 0]).matrix() for i in range(40)])
    poses[:, :3, 3] = np.c_[np.arange(40.0) + off_m, np.sin(np.arange(40)), np.zeros(40)]
    return pg.Trajectory.from_arrays(np.arange(40, dtype=np.int64) * 100_000_000, poses)


def judged(off_m: float, name: str = "estimate") -> pg.Evaluation:
    return pg.evaluate(drive(0), drive(off_m), align="none", name=name)


def test_a_table_has_a_column_for_each_system() -> None:
    table = pg.figure_table({"ours": judged(0.25), "a|b": judged(0.5)}, ["ate_rmse_m"])
    cells = json.loads(table.to_json())["rows"][0]["cells"]
    assert [cell["value"] for cell in cells] == pytest.approx([0.25, 0.5])
    assert cells[0]["best"]
    assert "a\\|b" in table.to_markdown()
    assert "\\toprule" in table.to_latex()
    assert "ATE RMSE [m]" in repr(table)
    with pytest.raises(pg.ArgumentError, match="did you mean ate_rmse_m"):
        pg.figure_table({"ours": judged(0.25)}, ["ate_rsme_m"])


def test_an_archive_is_what_numpy_and_zipfile_read(tmp_path: pathlib.Path) -> None:
    result = judged(0.25)
    path = tmp_path / "r.zip"
    result.save_for_evo(path, "gt.tum")
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        errors = np.load(io.BytesIO(archive.read("error_array.npy")))
        assert json.loads(archive.read("info.json"))["ref_name"] == "gt.tum"
    evo = pg.read_evo_result(str(path))
    assert np.array_equal(evo.arrays["error_array"], errors)
    assert evo.statistics["rmse"] == result["ate_rmse_m"]
    assert (evo.reference, evo.estimate, evo.label) == ("gt.tum", "estimate", "APE (m)")


def test_archives_that_python_writes_are_read(tmp_path: pathlib.Path) -> None:
    matrix = np.arange(12.0).reshape(3, 4)
    with zipfile.ZipFile(tmp_path / "r.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("info.json", '{"label": "RPE (deg)", "est_name": "a"}')
        archive.writestr("stats.json", '{"rmse": 0.5}')
        for name, array in {"c": matrix, "fortran": np.asfortranarray(matrix)}.items():
            bytes_of_array = io.BytesIO()
            np.save(bytes_of_array, array)
            archive.writestr(f"{name}.npy", bytes_of_array.getvalue())
    evo = pg.read_evo_result(str(tmp_path / "r.zip"))
    assert np.array_equal(evo.arrays["c"], matrix)
    assert np.array_equal(evo.arrays["fortran"], matrix)
    assert evo.statistics == {"rmse": 0.5}
    (tmp_path / "none.zip").write_text("no archive")
    with pytest.raises(pg.FileError, match="cannot be opened as a zip archive"):
        pg.read_evo_result(str(tmp_path / "none.zip"))
