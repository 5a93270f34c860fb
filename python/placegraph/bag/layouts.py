"""Folders of sequences: what was read of a bag, in the layouts that `open_dataset` recognizes."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .messages import DEPTH_UNIT_M, CameraModel, Matrix

_ADIS16448 = (1.7e-4, 2e-3, 1.9e-5, 3e-3)
"""Noise of a common inertial sensor, as EuRoC's calibration has it: see write_imu."""


@dataclass
class Images:
    """Images of a topic: files that are moved into the sequence."""

    topic: str
    stamps_ns: list[int] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)

    def sort(self) -> int:
        """Orders them by time and leaves out those of equal times; returns their number."""
        order = sorted(range(len(self.files)), key=lambda i: self.stamps_ns[i])
        kept = [i for k, i in enumerate(order)
                if k == 0 or self.stamps_ns[i] > self.stamps_ns[order[k - 1]]]
        removed = len(self.files) - len(kept)
        self.stamps_ns = [self.stamps_ns[i] for i in kept]
        self.files = [self.files[i] for i in kept]
        return removed

    def only(self, rows: list[int]) -> Images:
        """Some of the images."""
        return Images(self.topic, [self.stamps_ns[i] for i in rows], [self.files[i] for i in rows])


@dataclass
class Recording:
    """What was read of a bag."""

    image: Images
    right: Images | None = None
    depth: Images | None = None
    cameras: dict[str, CameraModel] = field(default_factory=dict)
    """By the topic of the images."""
    T_body: dict[str, Matrix] = field(default_factory=dict)
    """T_body_cam of the cameras, by the topic of the images."""
    T_cam_depth: Matrix | None = None
    imu: NDArray[np.float64] | None = None
    """Angular velocity and acceleration of the body, N x 6."""
    imu_stamps_ns: list[int] = field(default_factory=list)
    truth: _core.Trajectory | None = None
    """T_world_body."""

    @property
    def baseline_m(self) -> float:
        """Distance from the left camera to the right one, by the P of both; 0 if they have none."""
        if self.right is None or not {self.image.topic, self.right.topic} <= self.cameras.keys():
            return 0.0
        return self.cameras[self.right.topic].offset_m - self.cameras[self.image.topic].offset_m

    def truth_of_camera(self) -> _core.Trajectory | None:
        """T_world_cam of the (left) camera."""
        if self.truth is None:
            return None
        poses = self.truth.poses @ self.T_body.get(self.image.topic, np.eye(4))
        return _core.Trajectory.from_arrays(self.truth.stamps_ns, poses)


def pairs(left: Images, right: Images) -> tuple[Images, Images]:
    """The images whose times are at most a tenth of a frame apart, each used once."""
    times = np.array(right.stamps_ns, dtype=np.int64)
    step = np.median(np.diff(left.stamps_ns)) if len(left.stamps_ns) > 1 else 1e9
    rows: list[tuple[int, int]] = []
    for i, stamp in enumerate(left.stamps_ns):
        j = int(np.searchsorted(times, stamp))
        near = min((k for k in (j - 1, j) if 0 <= k < len(times)),
                   key=lambda k: abs(int(times[k]) - stamp), default=None)
        if near is not None and abs(int(times[near]) - stamp) <= step / 10 and (
                not rows or near > rows[-1][1]):
            rows.append((i, near))
    if not rows:
        raise _core.FileError(f"{left.topic}, {right.topic}: no two images have the same time")
    return left.only([i for i, _ in rows]), right.only([j for _, j in rows])


def seconds(stamp_ns: int) -> str:
    """A time [ns] in seconds, exactly."""
    return f"{stamp_ns // 1_000_000_000}.{stamp_ns % 1_000_000_000:09d}"


def _move(images: Images, folder: Path, by_time: bool = False) -> list[str]:
    """Moves the images into a folder, named by their number or time; returns their names."""
    folder.mkdir(parents=True)
    names = [f"{images.stamps_ns[i] if by_time else f'{i:06d}'}{file.suffix}"
             for i, file in enumerate(images.files)]
    for file, name in zip(images.files, names):
        os.replace(file, folder / name)
    return names


def _numbers(values: object) -> str:
    return ", ".join(repr(float(value)) for value in np.ravel(np.asarray(values, np.float64)))


def _write_times_and_poses(recording: Recording, images: Images, out: Path) -> None:
    (out / "times.txt").write_text("".join(f"{seconds(t)}\n" for t in images.stamps_ns))
    truth = recording.truth_of_camera()
    if truth is not None:
        truth.resample(np.array(images.stamps_ns, np.int64)).write(
            str(out / "poses.txt"), _core.TrajectoryFormat.KITTI)


def write_kitti(recording: Recording, out: Path) -> None:
    """A rectified pair in KITTI's layout: images and times as they are."""
    assert recording.right is not None
    left, right = pairs(recording.image, recording.right)
    lines = []
    for number, images in enumerate((left, right)):
        fx, fy, cx, cy = recording.cameras[left.topic].intrinsics
        matrix = [fx, 0, cx, -fx * number * recording.baseline_m, 0, fy, cy, 0, 0, 0, 1, 0]
        lines.append(f"P{number}: " + " ".join(repr(float(value)) for value in matrix) + "\n")
        _move(images, out / f"image_{number}")
    (out / "calib.txt").write_text("".join(lines))
    _write_times_and_poses(recording, left, out)


def write_calibrated(recording: Recording, out: Path, calibration: Path) -> None:
    """A folder of images beside a given file of calibration."""
    left, right = recording.image, recording.right
    depth = recording.depth
    if right is not None:
        left, right = pairs(left, right)
        _move(right, out / "right")
    elif depth is not None:
        left, depth = pairs(left, depth)
        _move(depth, out / "depth")
    _move(left, out / "images")
    shutil.copyfile(calibration, out / "calibration.yaml")
    _write_times_and_poses(recording, left, out)


def write_euroc(recording: Recording, out: Path) -> None:
    """Cameras with their distortion and mounting, and the truth of the body, in EuRoC's layout."""
    for number, images in enumerate((recording.image, recording.right)):
        if images is None:
            continue
        folder = out / "mav0" / f"cam{number}"
        names = _move(images, folder / "data", by_time=True)
        (folder / "data.csv").write_text("#timestamp [ns],filename\n" + "".join(
            f"{stamp},{name}\n" for stamp, name in zip(images.stamps_ns, names)))
        camera = recording.cameras[images.topic]
        (folder / "sensor.yaml").write_text(
            f"sensor_type: camera\nT_BS:\n  rows: 4\n  cols: 4\n"
            f"  data: [{_numbers(recording.T_body[images.topic])}]\n"
            f"resolution: [{camera.width}, {camera.height}]\ncamera_model: pinhole\n"
            f"intrinsics: [{_numbers(camera.intrinsics)}]\n{_euroc_distortion(camera)}")
    if recording.truth is not None:
        folder = out / "mav0" / "state_groundtruth_estimate0"
        folder.mkdir()
        recording.truth.write(str(folder / "data.csv"), _core.TrajectoryFormat.EUROC)


def _model_of(camera: CameraModel) -> str:
    """The name of the lens model; FileError for one that the layout does not know."""
    if not camera.coefficients:
        return "none"
    if camera.model in ("equidistant", "fisheye"):
        return "equidistant"
    if camera.model in ("plumb_bob", "radtan") and len(camera.coefficients) in (4, 5):
        return "radial-tangential"
    raise _core.FileError(f"the distortion model {camera.model!r} with {len(camera.coefficients)} "
                          "coefficients is not converted; --calib FILE gives the calibration")


def _euroc_distortion(camera: CameraModel) -> str:
    return (f"distortion_model: {_model_of(camera)}\n"
            f"distortion_coefficients: [{_numbers(camera.coefficients)}]\n")


def write_tum(recording: Recording, out: Path) -> None:
    """Images and depth, each with its times, in the layout of TUM RGB-D."""
    assert recording.depth is not None
    for name, images in (("rgb", recording.image), ("depth", recording.depth)):
        names = _move(images, out / name, by_time=True)
        (out / f"{name}.txt").write_text("# time filename\n" + "".join(
            f"{seconds(stamp)} {name}/{file}\n" for stamp, file in zip(images.stamps_ns, names)))
    camera, depth = (recording.cameras[images.topic]
                     for images in (recording.image, recording.depth))
    fx, fy, cx, cy = camera.intrinsics
    text = (f"width: {camera.width}\nheight: {camera.height}\n"
            f"fx: {fx!r}\nfy: {fy!r}\ncx: {cx!r}\ncy: {cy!r}\n")
    if camera.coefficients:
        text += (f"distortion:\n  model: {_model_of(camera).replace('-', '_')}\n"
                 f"  coefficients: [{_numbers(camera.coefficients)}]\n")
    text += f"depth:\n  unit_m: {DEPTH_UNIT_M}\n"
    if depth.intrinsics != camera.intrinsics or recording.T_cam_depth is not None:
        fx, fy, cx, cy = depth.intrinsics
        text += (f"  width: {depth.width}\n  height: {depth.height}\n"
                 f"  fx: {fx!r}\n  fy: {fy!r}\n  cx: {cx!r}\n  cy: {cy!r}\n")
        if recording.T_cam_depth is not None:
            text += f"  T_cam_depth: [{_numbers(recording.T_cam_depth[:3])}]\n"
    (out / "calibration.yaml").write_text(text)
    truth = recording.truth_of_camera()
    if truth is not None:
        truth.write(str(out / "groundtruth.txt"), _core.TrajectoryFormat.TUM)


def write_imu(recording: Recording, out: Path) -> str:
    """Inertial measurements as mav0/imu0 of EuRoC's layout; a note about their noise."""
    stamps = np.array(recording.imu_stamps_ns, np.int64)
    samples = recording.imu
    assert samples is not None
    rate_hz = 1e9 / float(np.median(np.diff(stamps)))
    _core.write_imu(str(out / "mav0" / "imu0"), stamps, np.ascontiguousarray(samples[:, :3]),
                    np.ascontiguousarray(samples[:, 3:]), rate_hz, list(_ADIS16448))
    return ("the noise of the inertial sensor is not in a bag: mav0/imu0/sensor.yaml has that of "
            "an ADIS16448")
