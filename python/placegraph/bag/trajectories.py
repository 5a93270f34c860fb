"""Trajectories of bags."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._types import Path as PathLike
from .messages import OLD_TRANSFORMS, POSE_TYPES, TRANSFORMS, Matrix, pose_of, stamp_of
from .topics import Known, opened

PATH = "nav_msgs/msg/Path"


def _chosen(topic: str, known: Known) -> list[str]:
    """The topics that have the poses of the wanted one."""
    if topic.startswith("tf:"):
        if len(topic.split(":")) != 3:
            raise _core.ArgumentError(f"topic {topic}: tf:PARENT:CHILD names two frames")
        return [name for name, (kind, _) in known.items() if kind in (TRANSFORMS, OLD_TRANSFORMS)]
    posed = [name for name, (kind, count) in known.items()
             if kind in (*POSE_TYPES, PATH) and count > 0]
    if topic not in known:
        raise _core.ArgumentError(
            f"topic {topic}: the bag has no such topic; of poses are {', '.join(posed) or 'none'}")
    if topic not in posed:
        raise _core.ArgumentError(f"topic {topic}: {known[topic][0]} has no poses")
    return [topic]


def _taken(topic: str, message: Any) -> list[Any]:
    """The messages with one pose each in a message of a topic."""
    if topic.startswith("tf:"):
        parent, child = (frame.strip("/") for frame in topic.split(":")[1:])
        return [each for each in message.transforms
                if (each.header.frame_id.strip("/"), each.child_frame_id.strip("/"))
                == (parent, child)]
    return list(message.poses) if hasattr(message, "poses") else [message]


def read_trajectory(bag: PathLike | Sequence[PathLike], topic: str) -> _core.Trajectory:
    """The poses of a topic of a bag (ROS 1, or ROS 2 as SQLite or MCAP), in the order of their times.

    Messages are PoseStamped, PoseWithCovarianceStamped, TransformStamped, Odometry or Path, of
    which the last one counts; `tf:PARENT:CHILD` takes a transform of /tf. Times are those of the
    headers. Of poses of one time the first is kept, with a warning (Doubt). ArgumentError: the bag
    has no such topic, or one without poses; FileError: it is damaged.
    """
    bags = [bag] if isinstance(bag, (str, os.PathLike)) else list(bag)
    paths = [Path(each) for each in bags]
    stamps: list[int] = []
    poses: list[Matrix] = []
    with opened(paths) as reader:
        known = {name: (info.msgtype or "several types", info.msgcount)
                 for name, info in reader.topics.items()}
        chosen = _chosen(topic, known)
        connections = [each for each in reader.connections if each.topic in chosen]
        for connection, received_ns, data in reader.messages(connections=connections):
            message = reader.deserialize(data, connection.msgtype)
            if connection.msgtype == PATH:
                stamps, poses = [], []  # a path holds all poses up to its time
            for each in _taken(topic, message):
                stamps.append(stamp_of(each.header, received_ns))
                poses.append(pose_of(each, topic)[0])
    if not stamps:
        raise _core.ArgumentError(f"topic {topic}: has no poses in the bag")
    order = np.argsort(np.array(stamps, np.int64), kind="stable")
    return _core.Trajectory.from_arrays(np.array(stamps, np.int64)[order], np.array(poses)[order])
