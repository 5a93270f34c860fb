"""open_dataset: frames, calibration, truth, inertial measurements."""

from __future__ import annotations

import gc
import pathlib
from typing import Any

import numpy as np
import pytest
from checks import assert_read_only, some
from numpy.typing import NDArray

import placegraph as pg

Image = NDArray[np.uint8]


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> pg.Dataset:
    folder = tmp_path_factory.mktemp("dataset") / "town"
    return pg.synthetic.render("town-loop", folder, frames=6, size=(320, 96))


def png(path: pathlib.Path) -> Image:
    """An image by another reader."""
    grey: Image = np.round(255 * matplotlib_image().imread(path)).astype(np.uint8)
    return grey


def matplotlib_image() -> Any:
    return pytest.importorskip("matplotlib.image")


def test_frames_are_items(drive: pg.Dataset) -> None:
    for index, expected in ((0, 0), (np.int64(2), 2), (-1, 5), (-6, 0)):
        frame = drive[int(index)] if index == 0 else drive[index]
        assert frame.id == expected and frame.right is not None
        assert np.array_equal(frame.image, drive.frame(expected).image)


def test_sensors_have_names(drive: pg.Dataset) -> None:
    assert drive.frame(1, "mono").right is None
    assert drive.frame(1, "stereo").right is not None
    assert drive.calibration("mono").baseline_m == 0
    assert sum(frame.right is None for frame in drive.frames("mono")) == 6
    world = pg.synthetic.World("town-loop", frames=1, size=(64, 48))
    assert world.frame(0, "mono").right is None


def test_a_sequence_tells_what_it_holds(drive: pg.Dataset) -> None:
    folder = pathlib.Path(drive.path)
    assert_read_only(drive)
    assert drive.name == "town" and drive.format == "kitti" and len(drive) == 6
    assert drive.sensors == (pg.Sensor.STEREO, pg.Sensor.MONO)
    assert "6 frames, kitti, stereo, mono" in repr(drive)
    times = np.loadtxt(folder / "times.txt")
    assert np.allclose(drive.stamps_ns / 1e9, times, atol=1e-9)
    assert drive.image_path(3) == str(folder / "image_0" / "000003.png")
    assert drive.notes() == [] and drive.images_rectified and drive.imu is None


def test_calibration_and_truth_are_those_of_the_files(drive: pg.Dataset) -> None:
    folder = pathlib.Path(drive.path)
    rows = {line.split(":")[0]: np.array(line.split()[1:], float).reshape(3, 4)
            for line in (folder / "calib.txt").read_text().splitlines() if line}
    calibration = drive.calibration()
    assert np.allclose(calibration.camera.K(), rows["P0"][:, :3])
    assert calibration.baseline_m == pytest.approx(-rows["P1"][0, 3] / rows["P1"][0, 0])
    assert drive.calibration(pg.Sensor.MONO).baseline_m == 0
    truth = np.loadtxt(folder / "poses.txt").reshape(-1, 3, 4)
    assert np.allclose(some(drive.ground_truth).poses[:, :3], truth, atol=1e-9)
    assert np.array_equal(some(drive.ground_truth).stamps_ns, drive.stamps_ns)


def test_frames_are_the_images_of_the_files(drive: pg.Dataset) -> None:
    folder = pathlib.Path(drive.path)
    frames = list(drive)
    assert [frame.id for frame in frames] == list(range(6))
    assert [frame.stamp_ns for frame in frames] == drive.stamps_ns.tolist()
    for frame in frames:
        name = f"{frame.id:06d}.png"
        assert np.array_equal(frame.image, png(folder / "image_0" / name))
        assert np.array_equal(some(frame.right), png(folder / "image_1" / name))
        assert frame.depth is None and frame.mask is None
    assert drive.frame(2, pg.Sensor.MONO).right is None


def test_frames_can_be_chosen(drive: pg.Dataset) -> None:
    assert [f.id for f in drive.frames(start=1, stop=5, step=2)] == [1, 3]
    assert [f.id for f in drive.frames(pg.Sensor.MONO, start=4, stop=100)] == [4, 5]
    assert all(f.right is None for f in drive.frames(pg.Sensor.MONO))


def test_images_and_truth_outlive_the_sequence(drive: pg.Dataset) -> None:
    again = pg.open_dataset(pathlib.Path(drive.path))
    frame = again.frame(1)
    truth, image = some(again.ground_truth), frame.image
    copy = image.copy()
    with pytest.raises(ValueError, match="read-only"):
        image[0, 0] = 0
    del again, frame
    gc.collect()
    assert np.array_equal(image, copy) and truth.posed == 6


def test_inertial_measurements_of_a_flight(tmp_path: pathlib.Path) -> None:
    flight = pg.synthetic.render("flight", tmp_path / "flight", duration_s=1, size=(160, 120))
    assert flight.format == "euroc" and flight.sensors == (pg.Sensor.MONO,)
    imu = some(flight.imu)
    assert_read_only(imu)
    rows = np.loadtxt(tmp_path / "flight" / "mav0" / "imu0" / "data.csv", delimiter=",")
    assert np.array_equal(imu.stamps_ns, rows[:, 0].astype(np.int64)) and len(imu) == len(rows)
    assert np.allclose(imu.gyro_rad_s, rows[:, 1:4]) and np.allclose(imu.accel_m_s2, rows[:, 4:7])
    assert np.isclose(imu.rate_hz, 1e9 / np.median(np.diff(imu.stamps_ns)), rtol=0.01)
    assert imu.noise.gyro > 0 and imu.noise.accel_bias_walk > 0


def test_research_data(research_data: pathlib.Path) -> None:
    dataset = pg.open_dataset(research_data / "sequences" / "kitti06_stereo51")
    assert len(dataset) == 51 and dataset.sensors[0] == pg.Sensor.STEREO
    assert some(dataset.ground_truth).posed == 51
    assert dataset.calibration().baseline_m == pytest.approx(0.54, abs=0.01)
