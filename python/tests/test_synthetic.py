"""Rendered worlds: the files of the program, and frames without files."""

from __future__ import annotations

import filecmp
import pathlib
import subprocess
from typing import Any

import numpy as np
import pytest
from checks import assert_read_only, some

import placegraph as pg

SIZE = (160, 120)


def same_folders(a: pathlib.Path, b: pathlib.Path) -> int:
    compared = filecmp.dircmp(a, b)
    names = compared.common_files
    _, different, unreadable = filecmp.cmpfiles(a, b, names, shallow=False)
    assert not (compared.left_only or compared.right_only or different or unreadable)
    return len(names) + sum(
        same_folders(a / name, b / name) for name in compared.common_dirs
    )


@pytest.mark.parametrize(
    "world, flags, arguments",
    [
        ("corridor-loop", [], {}),
        ("town-loop", ["--difficulty", "hard", "--seed", "7"], {"difficulty": "hard", "seed": 7}),
        ("town-loop", ["--mono", "--labels", "--flow"],
         {"sensor": pg.Sensor.MONO, "labels": True, "flow": True}),
        ("flight", ["--duration", "1"], {"duration_s": 1}),
        ("turning-walk", ["--defects", "hard-rgbd"], {"defects": "hard-rgbd"}),
        ("town-loop", ["--undulation-m", "0.02", "--rolling-shutter-s", "0.01"],
         {"defects": {"undulation_m": 0.02, "rolling_shutter_s": 0.01}}),
    ],
)
def test_files_are_those_of_the_program(world: str, flags: list[str],
                                        arguments: dict[str, Any], program: str,
                                        tmp_path: pathlib.Path) -> None:
    frames = [] if world == "flight" else ["--frames", "3"]
    subprocess.run([program, "synth", "sequence", world, "--out", tmp_path / "program",
                    "--size", "160x120", *frames, *flags], check=True, capture_output=True)
    if frames:
        arguments = {**arguments, "frames": 3}
    done = []
    dataset = pg.synthetic.render(world, tmp_path / "python", size=SIZE,
                                  on_frame=lambda i, n: done.append((i, n)), **arguments)
    assert same_folders(tmp_path / "program", tmp_path / "python") >= 6
    assert done == [(i + 1, len(dataset)) for i in range(len(dataset))]


def test_frames_in_memory_are_those_of_the_files(tmp_path: pathlib.Path) -> None:
    world = pg.synthetic.World("corridor-loop", frames=3, size=SIZE)
    dataset = world.write(tmp_path / "sequence")
    assert len(dataset) == len(world) == 3
    assert np.allclose(some(dataset.ground_truth).poses, world.ground_truth.poses, atol=1e-8)
    for frame, written in zip(world.frames(), dataset):
        assert_read_only(frame)
        assert np.array_equal(frame.image, written.image)
        assert np.allclose(some(frame.depth), some(written.depth), atol=0.0006)  # millimetres in the file
        assert frame.stamp_ns == written.stamp_ns and frame.id == written.id


def test_depth_and_flow_agree_with_the_poses() -> None:
    """A pixel's depth and the next pose say where it goes: that is its flow."""
    world = pg.synthetic.World("corridor-loop", frames=2, size=SIZE, difficulty="clean")
    rendered = world.render(0, pg.Sensor.RGBD, flow=True, labels=True, planes=True)
    camera = world.calibration(pg.Sensor.RGBD).camera
    T = np.linalg.inv(world.ground_truth.poses[1]) @ world.ground_truth.poses[0]
    flow, depth = some(rendered.flow), some(rendered.frame.depth)
    v, u = np.nonzero(~np.isnan(flow[..., 0]) & (depth > 0))
    assert len(u) > 10_000
    z = depth[v, u].astype(float)
    p = np.stack([(u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z])
    q = T[:3, :3] @ p + T[:3, 3:]
    moved = np.stack([camera.fx * q[0] / q[2] + camera.cx, camera.fy * q[1] / q[2] + camera.cy])
    assert np.abs(moved - np.stack([u, v]) - flow[v, u].T).max() < 0.01
    labels, planes = some(rendered.labels), some(rendered.planes)
    assert labels.dtype == np.uint8 and planes.dtype == np.uint16
    assert labels.max() < len(world.class_names())
    assert world.render(1, flow=True).flow is None  # no frame follows


def test_sensors_have_what_they_need() -> None:
    world = pg.synthetic.World("town-loop", frames=1, size=(160, 48))
    usual, mono = world.frame(0), world.frame(0, pg.Sensor.MONO)
    rgbd = world.frame(0, pg.Sensor.RGBD)
    assert usual.right is not None and usual.depth is None
    assert mono.right is None and mono.depth is None
    assert rgbd.right is None and some(rgbd.depth).shape == (48, 160)
    assert world.calibration().baseline_m > 0 and world.calibration().depth is None
    assert world.calibration(pg.Sensor.MONO).baseline_m == 0
    assert world.calibration(pg.Sensor.RGBD).depth is not None


def test_an_exception_leaves_no_files(tmp_path: pathlib.Path) -> None:
    def fail(done: int, total: int) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        pg.synthetic.render("corridor-loop", tmp_path / "sequence", frames=4, size=SIZE,
                            threads=2, on_frame=fail)
    assert list(tmp_path.iterdir()) == []


def test_the_example_runs(tmp_path: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    from placegraph.examples import first_drive

    first_drive.main([str(tmp_path / "drive"), "--frames", "30"])
    out = capsys.readouterr().out
    assert "30 of 30 frames posed" in out and "ATE" in out


def test_worlds_are_named() -> None:
    assert {"town-loop", "corridor-loop", "flight"} <= set(pg.synthetic.worlds())


def test_defect_sets_hold_every_defect() -> None:
    none, drive = pg.synthetic.defect_set("none"), pg.synthetic.defect_set("hard-drive")
    assert set(none) == set(drive) and set(none.values()) == {0}
    assert drive["rolling_shutter_s"] == 0.015
    with pytest.raises(pg.ArgumentError, match="soft"):
        pg.synthetic.defect_set("soft")
    with pytest.raises(pg.ArgumentError, match="depth_lag"):
        pg.synthetic.World("turning-walk", defects={"depth_lag": 0.02})
    with pytest.raises(pg.ArgumentError, match="depth_lag_s"):
        pg.synthetic.World("turning-walk", defects={"depth_lag_s": 3})


def test_a_calibration_error_changes_what_is_written_alone() -> None:
    exact = pg.synthetic.World("corridor-loop", frames=1, size=SIZE)
    world = pg.synthetic.World("corridor-loop", frames=1, size=SIZE,
                               defects={"calibration_error": 0.005})
    written, truth = world.calibration().camera, exact.calibration().camera
    assert 0 < abs(written.fx / truth.fx - 1) < 0.025
    assert np.array_equal(world.frame(0).image, exact.frame(0).image)
