"""From a bag to a sequence."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._types import Path as PathLike
from .._words import arguments_named, without_flags
from .frames import FrameTree
from .layouts import (
    Images,
    Recording,
    write_calibrated,
    write_euroc,
    write_imu,
    write_kitti,
    write_tum,
)
from .messages import (
    Matrix,
    camera_of,
    compressed_file,
    decode_depth,
    decode_image,
    pose_of,
    stamp_of,
)
from .topics import Topics, info_of, is_rectified, opened


# Flags whose arguments have other names in Python.
_ARGUMENTS = {"--calib FILE": "calibration", "(--list)": "(list_topics lists them)",
              "--right none": "right='none'"}


@dataclass
class Conversion:
    """What was written."""

    path: str
    """The folder of the sequence."""
    layout: str
    """Its layout: kitti, euroc, tum or images."""
    frames: int
    """Number of frames that `open_dataset` finds in it."""
    notes: list[str] = field(default_factory=list)
    """What was left out or assumed, one line each."""


class _Reader:
    """Takes the messages of a bag one by one."""

    def __init__(self, topics: Topics, calibrated: bool, folder: Path) -> None:
        self.topics = topics
        self.images = {name: Images(name) for name in topics.cameras()}
        self.recording = Recording(self.images[topics.image], self.images.get(topics.right),
                                   self.images.get(topics.depth))
        self.frames = FrameTree()
        self.frame_of: dict[str, str] = {}
        self.imu_frame = ""
        self.truth_frame = ""
        self._truth: dict[int, Matrix] = {}
        self._imu: dict[int, list[float]] = {}
        self._notes: list[str] = []
        self._infos = {} if calibrated else {
            info_of(name, topics.infos): name for name in topics.cameras()}
        self._folder = folder
        self._taken: dict[str, Callable[[str, Any, int], None]] = {}
        self._taken.update(dict.fromkeys(topics.transforms, self._transforms))
        self._taken.update(dict.fromkeys(self._infos, self._info))
        self._taken.update(dict.fromkeys(self.images, self._image))
        self._taken.update({topics.imu: self._imu_sample, topics.truth: self._pose})

    def wants(self, topic: str) -> bool:
        return topic in self._taken

    def take(self, topic: str, message: Any, received_ns: int) -> None:
        self._taken[topic](topic, message, received_ns)

    def _transforms(self, topic: str, message: Any, received_ns: int) -> None:
        for each in message.transforms:
            frames = f"tf:{each.header.frame_id.strip('/')}:{each.child_frame_id.strip('/')}"
            if frames == self.topics.truth:
                self._pose(topic, each, received_ns)
            else:
                self.frames.add(each, topic)

    def _info(self, topic: str, message: Any, received_ns: int) -> None:
        name = self._infos[topic]
        if name not in self.recording.cameras:
            camera = camera_of(message, topic, is_rectified(name))
            self.recording.cameras[name] = camera
            self._notes += [camera.note] if camera.note else []

    def _image(self, topic: str, message: Any, received_ns: int) -> None:
        images = self.images[topic]
        self.frame_of.setdefault(topic, message.header.frame_id.strip("/"))
        path = self._folder / f"{list(self.images).index(topic)}-{len(images.files)}"
        if hasattr(message, "encoding"):
            decode = decode_depth if topic == self.topics.depth else decode_image
            path = path.with_suffix(".png")
            _core.write_image(str(path), decode(message, topic))
        else:
            suffix, content = compressed_file(message, topic)
            path = path.with_suffix(suffix)
            path.write_bytes(content)
        images.files.append(path)
        images.stamps_ns.append(stamp_of(message.header, received_ns))

    def _imu_sample(self, topic: str, message: Any, received_ns: int) -> None:
        self.imu_frame = message.header.frame_id.strip("/")
        gyro, accel = message.angular_velocity, message.linear_acceleration
        self._imu.setdefault(stamp_of(message.header, received_ns),
                             [gyro.x, gyro.y, gyro.z, accel.x, accel.y, accel.z])

    def _pose(self, topic: str, message: Any, received_ns: int) -> None:
        T, self.truth_frame = pose_of(message, topic)
        self._truth.setdefault(stamp_of(message.header, received_ns), T)

    def finish(self, notes: list[str]) -> Recording:
        """What was read, ordered by time, in the frame of one body."""
        notes += self._notes
        for images in self.images.values():
            if not images.files:
                raise _core.FileError(f"{images.topic}: has no messages")
            if removed := images.sort():
                notes.append(f"{images.topic}: {removed} images of equal times are left out")
        for topic, name in self._infos.items():
            if name not in self.recording.cameras:
                raise _core.FileError(f"{topic}: has no messages")
        if self.topics.truth != "none" and not self._truth:
            raise _core.ArgumentError(f"--truth {self.topics.truth}: has no poses in the bag")
        if len(self._imu) > 1:
            self.recording.imu_stamps_ns = sorted(self._imu)
            self.recording.imu = np.array([self._imu[t] for t in self.recording.imu_stamps_ns])
        self._mount(notes)
        return self.recording

    def _mount(self, notes: list[str]) -> None:
        """The body is the inertial sensor, else what the truth names, else the left camera."""
        camera = self.frame_of[self.topics.image]
        body = self.imu_frame if self.recording.imu is not None else self.truth_frame or camera
        left = self._transform(body, camera, notes)
        model = self.recording.cameras.get(self.topics.image)
        if model is not None and model.rectified and np.any(model.R):
            left = left @ rotation(model.R.T)  # the frame is that of the camera as it is mounted
        self.recording.T_body[self.topics.image] = left
        if self.recording.right is not None:
            right = self.frame_of[self.topics.right]
            T_frames = None if right == camera else self.frames.transform(camera, right)
            T = _T_left_right(self.recording, T_frames)
            if T_frames is not None and (note := _other_mounting(self.recording, T, T_frames)):
                notes.append(f"{note} (frames {camera!r} and {right!r})")
            self.recording.T_body[self.topics.right] = left @ T
        if self.recording.depth is not None:
            self.recording.T_cam_depth = self.frames.transform(
                camera, self.frame_of[self.topics.depth])
            depth = self.recording.T_cam_depth
            if depth is not None and np.array_equal(depth, np.eye(4)):
                self.recording.T_cam_depth = None
        if self._truth:
            stamps = sorted(self._truth)
            if not self.truth_frame:
                notes.append(f"the truth does not say what it is of: of the frame {body!r}, it is "
                             "assumed")
            T_pose_body = self._transform(self.truth_frame or body, body, notes)
            poses = np.array([self._truth[t] @ T_pose_body for t in stamps])
            self.recording.truth = _core.Trajectory.from_arrays(np.array(stamps, np.int64), poses)

    def _transform(self, parent: str, child: str, notes: list[str]) -> Matrix:
        T = self.frames.transform(parent, child)
        if T is None:
            notes.append(f"no static transform joins the frames {parent!r} and {child!r}: they are "
                         "taken as equal")
        return np.eye(4) if T is None else T


def rotation(R: Matrix) -> Matrix:
    """The 4x4 matrix of a rotation."""
    T = np.eye(4)
    T[:3, :3] = R
    return T


def _T_left_right(recording: Recording, T: Matrix | None) -> Matrix:
    """From the right camera to the left one: by rectification and baseline, else by the frames."""
    assert recording.right is not None
    left, right = (recording.cameras.get(name.topic) for name in (recording.image, recording.right))
    if left is None or right is None:
        return np.eye(4)  # the file of calibration has it
    if recording.baseline_m > 0 and np.any(left.R) and np.any(right.R):
        shift = np.eye(4)
        shift[0, 3] = recording.baseline_m
        if left.rectified and right.rectified:
            return shift
        return rotation(left.R.T) @ shift @ rotation(right.R)
    if T is None:
        raise _core.FileError(f"{recording.right.topic}: camera_info has no baseline, and no "
                              "static transform joins the cameras; --calib FILE gives it all")
    return T


def _other_mounting(recording: Recording, T: Matrix, T_frames: Matrix) -> str:
    """What to say where the static transforms put the right camera elsewhere than camera_info, by
    more than a twentieth of the baseline; empty where both agree."""
    left = recording.cameras.get(recording.image.topic)
    if left is None:
        return ""
    seen = left.R.T @ T[:3, 3] if left.rectified and np.any(left.R) else T[:3, 3]
    if np.linalg.norm(T_frames[:3, 3] - seen) <= 0.05 * np.linalg.norm(seen):
        return ""
    places = [", ".join(f"{value:.3f}" for value in t) for t in (T_frames[:3, 3], seen)]
    return (f"the right camera is at ({places[0]}) m from the left one by the static transforms, "
            f"at ({places[1]}) m by camera_info, which is taken")


def _write(recording: Recording, out: Path, calibration: Path | None, notes: list[str]) -> str:
    """Writes the sequence in the layout that fits."""
    if recording.imu is not None:
        notes.append(write_imu(recording, out))
    if calibration is not None:
        write_calibrated(recording, out, calibration)
        return "images"
    if recording.depth is not None and recording.right is None:
        write_tum(recording, out)
        return "tum"
    rectified = all(camera.rectified for camera in recording.cameras.values())
    if rectified and recording.imu is None and recording.baseline_m > 0:
        write_kitti(recording, out)
        return "kitti"
    write_euroc(recording, out)
    return "euroc"


def convert_by_command(
    bags: PathLike | Sequence[PathLike],
    out: PathLike,
    topics: Topics | None = None,
    *,
    calibration: PathLike | None = None,
    force: bool = False,
) -> Conversion:
    """`convert`, whose messages name the flags of `python -m placegraph.bag`."""
    paths = [Path(bags)] if isinstance(bags, (str, os.PathLike)) else [Path(bag) for bag in bags]
    target = Path(out)
    if target.exists() and not force:
        raise _core.ArgumentError(f"{target}: exists already; --force replaces it")
    if not target.absolute().parent.is_dir():
        raise _core.ArgumentError(f"{target}: there is no folder {target.absolute().parent}")
    if calibration is not None and not Path(calibration).is_file():
        raise _core.FileError(f"{calibration}: there is no such file")
    work = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.absolute().parent))
    try:
        result = _convert(paths, work, topics or Topics(),
                          None if calibration is None else Path(calibration))
        if target.exists():
            shutil.rmtree(target) if target.is_dir() else target.unlink()
        os.replace(work / "sequence", target)
    finally:
        shutil.rmtree(work, ignore_errors=True)
    result.path = str(target)
    return result


def convert(
    bags: PathLike | Sequence[PathLike],
    out: PathLike,
    topics: Topics | None = None,
    *,
    calibration: PathLike | None = None,
    force: bool = False,
) -> Conversion:
    """Writes a bag as a sequence that `open_dataset` and the program read.

    `bags`: a bag, or several of ROS 1 that follow each other; `out`: a folder that does not exist
    (`force`: is replaced), which appears when it is complete; `topics`: None for a choice by types
    and names; `calibration`: a file for bags without camera_info.
    """
    with arguments_named(_ARGUMENTS):
        result = convert_by_command(bags, out, topics, calibration=calibration, force=force)
    result.notes = [without_flags(note, _ARGUMENTS) for note in result.notes]
    return result


def _convert(paths: list[Path], work: Path, topics: Topics,
             calibration: Path | None) -> Conversion:
    (work / "images").mkdir()
    (work / "sequence").mkdir()
    with opened(paths) as bag:
        known = {name: (info.msgtype or "", info.msgcount) for name, info in bag.topics.items()}
        chosen, notes = topics.chosen(known, calibration is not None)
        reader = _Reader(chosen, calibration is not None, work / "images")
        connections = [each for each in bag.connections if reader.wants(each.topic)]
        for connection, received_ns, data in bag.messages(connections=connections):
            reader.take(connection.topic, bag.deserialize(data, connection.msgtype), received_ns)
        recording = reader.finish(notes)
    layout = _write(recording, work / "sequence", calibration, notes)
    return Conversion("", layout, len(_core.open_dataset(str(work / "sequence"))), notes)
