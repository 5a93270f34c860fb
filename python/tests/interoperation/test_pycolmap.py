"""Maps as reconstructions of pycolmap, against the files that the program writes."""

from __future__ import annotations

import pathlib
import subprocess

import numpy as np
import pytest

import placegraph as pg

pycolmap = pytest.importorskip("pycolmap")


def test_reconstruction_is_the_exported_model(run_folder: pathlib.Path, program: str,
                                              tmp_path: pathlib.Path) -> None:
    from placegraph import colmap

    opened = pg.Map.open(run_folder)
    ours = colmap.to_pycolmap(opened)
    subprocess.run([program, "map", "export", str(run_folder), "--colmap",
                    str(tmp_path / "model")], check=True, capture_output=True)
    theirs = pycolmap.Reconstruction(str(tmp_path / "model"))
    assert ours.num_images() == theirs.num_images() == len(opened.tables.keyframes["id"])
    assert ours.num_points3D() == theirs.num_points3D() > 50
    for i in theirs.images:
        a, b = ours.image(i), theirs.image(i)
        assert a.name == b.name
        assert np.array_equal(a.cam_from_world().matrix(), b.cam_from_world().matrix())
        assert len(a.points2D) == len(b.points2D)
    # COLMAP's own error of its reprojections.
    assert ours.compute_mean_reprojection_error() < 1.0


def test_reconstruction_becomes_a_map(run_folder: pathlib.Path, drive: pathlib.Path) -> None:
    from placegraph import colmap

    reconstruction = colmap.to_pycolmap(pg.Map.open(run_folder))
    back = colmap.from_pycolmap(reconstruction, drive, metric=True)
    assert back.metric
    keyframes = back.tables.keyframes
    assert len(keyframes["id"]) == reconstruction.num_images()
    names = {image.name: image for image in reconstruction.images.values()}
    for frame, pose in zip(keyframes["frame"].tolist(), keyframes["pose"]):
        image = names[f"image_0/{frame:06d}.png"]
        world_from_cam = image.cam_from_world().inverse().matrix()
        np.testing.assert_allclose(pose[:3], world_from_cam, atol=1e-9)
    assert len(back.landmarks) == reconstruction.num_points3D()


def test_wrong_reconstructions(run_folder: pathlib.Path, drive: pathlib.Path,
                               tmp_path: pathlib.Path) -> None:
    from placegraph import colmap

    with pytest.raises(pg.ArgumentError, match="reconstruction"):
        colmap.from_pycolmap(3, drive)
    with pytest.raises(pg.Error, match="no camera in it"):
        colmap.from_pycolmap(pycolmap.Reconstruction(), drive)
    reconstruction = colmap.to_pycolmap(pg.Map.open(run_folder))
    with pytest.raises(pg.Error, match="absent"):
        colmap.from_pycolmap(reconstruction, tmp_path / "absent")
