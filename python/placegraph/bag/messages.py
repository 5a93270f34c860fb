"""Messages of ROS as images, cameras and poses."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core

Matrix = NDArray[np.float64]

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
IMU = "sensor_msgs/msg/Imu"
TRANSFORMS = "tf2_msgs/msg/TFMessage"
OLD_TRANSFORMS = "tf/msg/tfMessage"
POSE_TYPES = ("geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/TransformStamped",
              "geometry_msgs/msg/PoseWithCovarianceStamped", "nav_msgs/msg/Odometry")

_CHANNELS = {"mono8": 1, "8UC1": 1, "bgr8": 3, "8UC3": 3, "rgb8": 3, "bgra8": 4, "rgba8": 4,
             "8UC4": 4}
_BAYER = ("rggb", "bggr", "gbrg", "grbg")
_DEEP = ("mono16", "16UC1")

DEPTH_UNIT_M = 0.001
"""Unit of the depth images that are written."""


def stamp_of(header: Any, received_ns: int) -> int:
    """Time of a message [ns]: that of its header, or of its receipt if the header has none."""
    stamp = int(header.stamp.sec) * 1_000_000_000 + int(header.stamp.nanosec)
    return stamp if stamp > 0 else received_ns


def _rows(message: Any, channels: int, dtype: str, topic: str) -> NDArray[Any]:
    """The pixels of an Image message, whose rows may be padded."""
    size = np.dtype(dtype).itemsize
    used = message.width * channels * size
    data = np.asarray(message.data, dtype=np.uint8)
    if message.step < used or len(data) < message.height * message.step or used == 0:
        raise _core.FileError(f"{topic}: an image of {message.width} x {message.height} "
                              f"{message.encoding} has {len(data)} bytes")
    rows = data[:message.height * message.step].reshape(message.height, message.step)[:, :used]
    stored = np.ascontiguousarray(rows).view((">" if message.is_bigendian else "<") + dtype)
    shape = (message.height, message.width, channels)
    return np.ascontiguousarray(stored.astype(dtype, copy=False)).reshape(
        shape if channels > 1 else shape[:2])


def decode_image(message: Any, topic: str) -> NDArray[Any]:
    """The pixels of an Image message: grey of 8 or 16 bits, or BGR."""
    encoding = message.encoding
    if encoding in _DEEP:
        return _rows(message, 1, "u2", topic)
    if encoding.startswith("bayer_") and encoding[6:10] in _BAYER and encoding[10:] == "8":
        return _core.demosaic(_rows(message, 1, "u1", topic), encoding[6:10])
    if encoding not in _CHANNELS:
        raise _core.FileError(f"{topic}: images of the encoding {encoding!r} are not converted")
    pixels = _rows(message, _CHANNELS[encoding], "u1", topic)
    if encoding.startswith("rgb"):
        pixels = pixels[:, :, 2::-1]
    return np.ascontiguousarray(pixels[:, :, :3] if pixels.ndim == 3 else pixels)


def decode_depth(message: Any, topic: str) -> NDArray[np.uint16]:
    """The depth of an Image message in steps of DEPTH_UNIT_M; 0 where nothing was measured."""
    if message.encoding in _DEEP:
        return _rows(message, 1, "u2", topic)
    if message.encoding != "32FC1":
        raise _core.FileError(
            f"{topic}: depth of the encoding {message.encoding!r} is not converted")
    steps = _rows(message, 1, "f4", topic).astype(np.float64) / DEPTH_UNIT_M
    known = np.isfinite(steps) & (steps > 0) & (steps < 65534.5)
    return np.where(known, np.rint(np.where(known, steps, 0)), 0).astype(np.uint16)


def compressed_file(message: Any, topic: str) -> tuple[str, bytes]:
    """The extension and the bytes of the file in a CompressedImage message."""
    data = np.ascontiguousarray(message.data, dtype=np.uint8).tobytes()
    if "compressedDepth" in message.format:
        if "32FC1" in message.format:
            raise _core.FileError(f"{topic}: compressedDepth of 32FC1 is not converted")
        data = data[12:]  # behind a header of the transport
    if data.startswith(b"\xff\xd8"):
        return ".jpg", data
    if data.startswith(b"\x89PNG"):
        return ".png", data
    raise _core.FileError(f"{topic}: compressed images of the format {message.format!r} are "
                          "neither JPEG nor PNG")


def matrix_of(position: Any, orientation: Any, topic: str) -> Matrix:
    """The 4x4 matrix of a position and a quaternion of ROS."""
    quaternion = [orientation.x, orientation.y, orientation.z, orientation.w]
    try:
        pose = _core.SE3.from_quaternion_xyzw(
            np.array(quaternion), np.array([position.x, position.y, position.z]))
    except _core.ArgumentError as error:
        raise _core.FileError(f"{topic}: {error}") from None
    return np.asarray(pose.matrix())


def pose_of(message: Any, topic: str) -> tuple[Matrix, str]:
    """The pose in a message of POSE_TYPES, and the frame that has it; empty if it is unnamed."""
    if hasattr(message, "transform"):
        transform = message.transform
        return (matrix_of(transform.translation, transform.rotation, topic),
                message.child_frame_id.strip("/"))
    pose = message.pose.pose if hasattr(message.pose, "pose") else message.pose
    child = getattr(message, "child_frame_id", "").strip("/")
    return matrix_of(pose.position, pose.orientation, topic), child


@dataclass
class CameraModel:
    """A camera_info message."""

    frame: str
    width: int
    height: int
    model: str
    distortion: list[float]
    K: Matrix
    R: Matrix
    P: Matrix
    rectified: bool = field(default=False)
    """Whether its images are rectified: then P describes them."""
    note: str = field(default="")
    """What is assumed of it, one line; empty: nothing."""

    @property
    def offset_m(self) -> float:
        """How far the camera stands to the right of the frame of P, which all rectified cameras
        share [m]."""
        return -float(self.P[0, 3] / self.P[0, 0]) if self.P[0, 0] > 0 else 0.0

    @property
    def intrinsics(self) -> list[float]:
        """fx, fy, cx, cy of the images."""
        matrix = self.P if self.rectified else self.K
        return [float(matrix[i]) for i in ((0, 0), (1, 1), (0, 2), (1, 2))]

    @property
    def coefficients(self) -> list[float]:
        """Distortion coefficients of the images; none if they have no distortion."""
        return [] if self.rectified or not any(self.distortion) else self.distortion


def camera_of(message: Any, topic: str, rectified: bool) -> CameraModel:
    """The camera of a camera_info message; `rectified`: of images that are rectified."""
    def numbers(name: str) -> NDArray[np.float64]:  # capital letters in ROS 1
        value = getattr(message, name, None)
        return np.asarray(getattr(message, name.upper()) if value is None else value, np.float64)

    if message.width == 0 or message.height == 0:
        raise _core.FileError(f"{topic}: the camera is not calibrated (an image of 0 pixels)")
    camera = CameraModel(message.header.frame_id.strip("/"), int(message.width),
                         int(message.height), message.distortion_model, numbers("d").tolist(),
                         numbers("k").reshape(3, 3), numbers("r").reshape(3, 3),
                         numbers("p").reshape(3, 4))
    if message.distortion_model == "rational_polynomial" and not any(camera.distortion[5:]):
        camera.model, camera.distortion = "plumb_bob", camera.distortion[:5]
    # Without distortion and with K = P, rectification would change nothing but the axes: it is done.
    done = (not any(camera.distortion) and np.any(camera.R) and camera.P[0, 0] > 0
            and np.allclose(camera.K, camera.P[:, :3], rtol=1e-9))
    if done and not rectified:
        turn_deg = np.rad2deg(np.arccos(np.clip((np.trace(camera.R) - 1) / 2, -1, 1)))
        if turn_deg > 0.01:
            camera.note = (f"{topic}: D = 0 and K = P say that the images are rectified: R, a "
                           f"rotation by {turn_deg:.2f} deg, is not applied")
        camera.R = np.eye(3)
    camera.rectified = rectified or bool(done)
    if not (camera.intrinsics[0] > 0 and camera.intrinsics[1] > 0):
        raise _core.FileError(f"{topic}: the camera is not calibrated (a focal length of 0)")
    return camera
