"""Recorded sequences: frames, calibration, ground truth, inertial measurements."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

from . import _core
from ._types import Path, SensorName, sensor_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Dataset:
    """A recorded sequence of images, with one interface for all file layouts.

        dataset = pg.open_dataset("kitti/sequences/00")
        for frame in dataset.frames():
            result = slam.add_frame(frame)

    Frames are grey, undistorted and (stereo) rectified, and stamps increase. Where a sensor can be
    chosen, as a Sensor or by its name, None is the best one of the recording. Several threads may
    read frames at once.
    """

    def __init__(self, core: _core.Dataset, path: str) -> None:
        self._core = core
        self._path = path

    @property
    def path(self) -> str:
        """The absolute path from which the sequence was opened."""
        return self._path

    @property
    def name(self) -> str:
        """The last folder of the path, for messages and results."""
        return self._core.name

    @property
    def format(self) -> str:
        """The kind of recording: "kitti", "tum", "euroc", "images", "video", ..."""
        return self._core.format

    def __len__(self) -> int:
        return len(self._core)

    @property
    def sensors(self) -> tuple[_core.Sensor, ...]:
        """The sensors that the recording supports, best first."""
        return self._core.sensors

    def calibration(self, sensor: _core.Sensor | SensorName | None = None) -> _core.Calibration:
        """Calibration of the images of a sensor; ArgumentError if the recording lacks it."""
        return self._core.calibration(self._sensor(sensor))

    @property
    def stamps_ns(self) -> NDArray[np.int64]:
        """Times of all frames [ns], without reading them."""
        return self._core.stamps_ns

    def image_path(self, index: int) -> str:
        """Path of the (left) image of a frame; empty where frames are not files (videos)."""
        return self._core.image_path(_index(index))

    def frame(self, index: int, sensor: _core.Sensor | SensorName | None = None) -> _core.Frame:
        """Reads a frame with the images that the sensor needs.

        FileError names an image that is missing, unreadable or of another size than the
        calibration; ArgumentError is raised for an index beyond the end and a missing sensor.
        """
        return self._core.frame(_index(index), self._sensor(sensor))

    def frames(
        self,
        sensor: _core.Sensor | SensorName | None = None,
        *,
        start: int = 0,
        stop: int | None = None,
        step: int = 1,
    ) -> Iterator[_core.Frame]:
        """Reads frames one after the other: those of range(start, stop, step)."""
        chosen = self._sensor(sensor)
        count = len(self)
        end = count if stop is None else min(_index(stop, "stop"), count)
        if step < 1:
            raise _core.ArgumentError(f"step: {step} is not positive")
        return (self._core.frame(i, chosen) for i in range(_index(start, "start"), end, step))

    def __getitem__(self, index: int) -> _core.Frame:
        """Reads a frame with the images of the best sensor; -1 is the last one.

        IndexError beyond the ends; `frames` takes parts of the sequence.
        """
        at = operator.index(index)
        count = len(self)
        if not -count <= at < count:
            raise IndexError(f"index: {at}: there are {count} frames")
        return self.frame(at % count)

    def __iter__(self) -> Iterator[_core.Frame]:
        return self.frames()

    @property
    def ground_truth(self) -> _core.Trajectory | None:
        """True poses T_world_cam, one entry per frame; None if there are none."""
        return self._core.ground_truth

    @property
    def images_rectified(self) -> bool:
        """Whether the recording states that its images are rectified, as a stereo pair's are."""
        return self._core.images_rectified

    def notes(self) -> list[_core.DataNote]:
        """Notes about skipped and implausible data."""
        return self._core.notes()

    @property
    def imu(self) -> _core.ImuRecording | None:
        """Inertial measurements of a recording in EuRoC's layout; None if there are none."""
        for folder in ("mav0/imu0", "imu0"):
            path = os.path.join(self._path, folder)
            if os.path.exists(os.path.join(path, "data.csv")):
                return _core.read_imu(path)
        return None

    def _sensor(self, sensor: _core.Sensor | SensorName | None) -> _core.Sensor:
        chosen = sensor_of(sensor)
        return self._core.sensors[0] if chosen is None else chosen

    def __repr__(self) -> str:
        sensors = ", ".join(sensor.name.lower() for sensor in self.sensors)
        return f"<placegraph.Dataset {self.name}: {len(self)} frames, {self.format}, {sensors}>"


def _index(value: int, name: str = "index") -> int:
    if value < 0:
        raise _core.ArgumentError(f"{name}: {value} is negative")
    return value


def open_dataset(path: Path) -> Dataset:
    """Recognizes the layout of a folder or video file and opens it as a sequence.

    Layouts: EuRoC, TUM RGB-D, KITTI (odometry and raw), 7-Scenes, a folder of images with its
    calibration.yaml, a video. Raises FileError if none is recognized, the path does not exist or
    the sequence is broken.
    """
    text = os.fspath(path)
    return Dataset(_core.open_dataset(text), os.path.abspath(text))
