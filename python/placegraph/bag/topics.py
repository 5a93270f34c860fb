"""Which topics of a bag are which sensor."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .. import _core
from .._optional import optional
from .messages import (
    CAMERA_INFO,
    COMPRESSED,
    IMAGE,
    IMU,
    OLD_TRANSFORMS,
    POSE_TYPES,
    TRANSFORMS,
)

Known = dict[str, tuple[str, int]]
"""Type and number of messages of topics, by their names."""

_RIGHT = re.compile(r"right|cam1|camera1|camera_1|infra2|image_1\b")
_LEFT = re.compile(r"left|cam0|camera0|camera_0|infra1|image_0\b")
_DEPTH = re.compile(r"depth")
_TRUTH = re.compile(r"truth|ground|\bgt\b|vicon|mocap|optitrack|leica")


@contextmanager
def opened(paths: list[Path]) -> Iterator[Any]:
    """A reader of bags; whatever it fails with becomes a FileError that names the bag."""
    optional("rosbags", "bag")
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    name = ", ".join(str(path) for path in paths)
    for path in paths:
        if not path.exists():
            raise _core.FileError(f"{path}: there is no such bag")
    try:
        with AnyReader(paths, default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
            yield reader
    except (_core.Error, OSError, KeyboardInterrupt):
        raise
    except Exception as error:  # rosbags and its storages raise many types for a damaged file
        reason = " ".join(str(error).split()) or type(error).__name__
        raise _core.FileError(f"{name}: is no bag, or is damaged: {reason}") from error


def list_topics(paths: list[Path]) -> Known:
    """Type and number of messages of every topic, by its name."""
    with opened(paths) as reader:
        return {name: (info.msgtype or "several types", info.msgcount)
                for name, info in sorted(reader.topics.items())}


@dataclass
class Topics:
    """Topics by what they are; empty names are chosen by type, "none" leaves a sensor out."""

    image: str = ""
    """Images of the left or only camera."""
    right: str = ""
    """Images of the right camera."""
    depth: str = ""
    """Depth images."""
    imu: str = ""
    """Inertial measurements."""
    truth: str = ""
    """The true trajectory: a topic of poses, or tf:PARENT:CHILD."""
    transforms: list[str] = field(default_factory=list)
    infos: list[str] = field(default_factory=list)

    def chosen(self, known: Known, calibrated: bool) -> tuple[Topics, list[str]]:
        """Real topics in place of empty names, and notes. `calibrated`: no camera_info is needed.

        Raises ArgumentError, which names the option, where a topic is unknown or the choice is
        not clear.
        """
        notes: list[str] = []
        by_type = _by_type(known)
        images = by_type(IMAGE) + [name for name in by_type(COMPRESSED)
                                   if _without_transport(name) not in by_type(IMAGE)]
        depths = [name for name in images if _DEPTH.search(name)]
        views = [name for name in images if name not in depths]
        image, right = _views(self, views, known)
        if self.depth not in ("", "none") and not self.right:
            right = "none"  # what is named has priority
        depth = "none" if right != "none" else _one(self.depth, "--depth", depths, known)
        result = Topics(image, right, depth, _one(self.imu, "--imu", by_type(IMU), known),
                        _truth(self.truth, known, by_type, notes),
                        by_type(TRANSFORMS) + by_type(OLD_TRANSFORMS), by_type(CAMERA_INFO))
        if right != "none" and depths:
            notes.append(f"{', '.join(depths)}: left out beside a stereo pair (--right none)")
        if not calibrated:
            for topic in result.cameras():
                info_of(topic, result.infos)
        return result, notes

    def cameras(self) -> list[str]:
        """The topics of images, depth last."""
        return [name for name in (self.image, self.right, self.depth) if name != "none"]


def _by_type(known: Known) -> Callable[[str], list[str]]:
    return lambda wanted: [name for name, (msgtype, count) in known.items()
                           if msgtype == wanted and count > 0]


def _without_transport(name: str) -> str:
    """The topic of images, without the way in which they are sent."""
    return re.sub(r"/(compressed|compressedDepth)$", "", name)


def is_rectified(topic: str) -> bool:
    """Whether images are rectified, by the name of their topic: image_rect, image_rect_color."""
    return "rect" in _without_transport(topic).rsplit("/", 1)[-1]


def info_of(topic: str, infos: list[str]) -> str:
    """The camera_info of images: in their namespace, as image transport has it."""
    folder = _without_transport(topic).rsplit("/", 1)[0]
    for candidate in (f"{folder}/camera_info", f"{_without_transport(topic)}/camera_info"):
        if candidate in infos:
            return candidate
    raise _core.ArgumentError(f"{topic}: there is no {folder}/camera_info in the bag; --calib FILE "
                              "gives the calibration")


def _given(name: str, option: str, known: Known) -> str:
    if name != "none" and name not in known:
        raise _core.ArgumentError(f"{option} {name}: the bag has no such topic (--list)")
    return name


def _one(name: str, option: str, found: list[str], known: Known) -> str:
    """The given topic, or the one that was found; "none" if there is none."""
    if name:
        return _given(name, option, known)
    if len(found) > 1:
        raise _core.ArgumentError(f"{option}: one of {', '.join(found)} is to be named, or none")
    return found[0] if found else "none"


def _views(given: Topics, views: list[str], known: Known) -> tuple[str, str]:
    """The topics of the left and the right images."""
    image = _given(given.image, "--image", known) if given.image else ""
    right = _given(given.right, "--right", known) if given.right else ""
    if image == "none":
        raise _core.ArgumentError("--image none: a sequence needs images")
    rights = [name for name in views if _RIGHT.search(name)]
    if not image:
        others = [name for name in views if name not in rights and name != right]
        lefts = [name for name in others if _LEFT.search(name)] or others
        if not lefts and not rights:
            raise _core.FileError("the bag has no images")
        image = _one("", "--image", lefts or rights, known)
    if not right:
        # Both names differ in the side alone.
        fitting = [name for name in rights
                   if name != image and _RIGHT.sub("", name) == _LEFT.sub("", image)]
        right = _one("", "--right", fitting, known)
    return image, right


def _truth(name: str, known: Known, by_type: Callable[[str], list[str]],
           notes: list[str]) -> str:
    """The topic of true poses. Of odometry nobody knows whether it is true."""
    if name.startswith("tf:"):
        frames = [frame.strip("/") for frame in name.split(":")]
        if len(frames) != 3:
            raise _core.ArgumentError(f"--truth {name}: tf:PARENT:CHILD names two frames")
        return ":".join(frames)
    if name:
        _given(name, "--truth", known)
        if name != "none" and known[name][0] not in POSE_TYPES:
            raise _core.ArgumentError(f"--truth {name}: {known[name][0]} is no pose")
        return name
    poses = [topic for kind in POSE_TYPES for topic in by_type(kind)]
    true = [topic for topic in poses if _TRUTH.search(topic)]
    if len(true) == 1:
        return true[0]
    if poses:
        notes.append(f"no ground truth is written: --truth names one of {', '.join(poses)}")
    return "none"
