"""Bags of ROS 1 and 2 as sequences: the same images, cameras, truth and inertial measurements."""

from __future__ import annotations

import pathlib
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import _core

pytest.importorskip("rosbags")

from placegraph.bag import Topics, convert, list_topics, read_trajectory  # noqa: E402
from placegraph.bag.__main__ import main  # noqa: E402

KINDS = ("ros1", "sqlite", "mcap")
STEP_NS = 100_000_000
BEGIN_NS = 1_600_000_000_123_456_789


class BagWriter:
    """Writes messages by rosbags' own writers, in one of the three kinds."""

    def __init__(self, folder: pathlib.Path, kind: str) -> None:
        from rosbags import rosbag1, rosbag2
        from rosbags.rosbag2 import StoragePlugin
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore

        self.ros1 = kind == "ros1"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.ROS2_HUMBLE)
        if self.ros1:  # rosbags' own types of ROS 1 lack those of tf
            self.store.register(get_types_from_msg(
                "geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
        self.path = folder / ("bag.bag" if self.ros1 else "bag")
        self.writer: Any = rosbag1.Writer(self.path) if self.ros1 else rosbag2.Writer(
            self.path, version=9,
            storage_plugin=StoragePlugin.MCAP if kind == "mcap" else StoragePlugin.SQLITE3)
        self.connections: dict[str, Any] = {}
        self.sequence = 0

    def __enter__(self) -> BagWriter:
        self.writer.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.writer.close()

    def make(self, name: str, **values: Any) -> Any:
        return self.store.types[name](**values)

    def header(self, stamp_ns: int, frame: str) -> Any:
        stamp = self.make("builtin_interfaces/msg/Time", sec=stamp_ns // 10**9,
                          nanosec=stamp_ns % 10**9)
        sequence = {"seq": self.sequence} if self.ros1 else {}
        return self.make("std_msgs/msg/Header", stamp=stamp, frame_id=frame, **sequence)

    def write(self, topic: str, msgtype: str, stamp_ns: int, **values: Any) -> None:
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(
                topic, msgtype, typestore=self.store)
        message = self.make(msgtype, **values)
        data = (self.store.serialize_ros1 if self.ros1 else self.store.serialize_cdr)(
            message, msgtype)
        self.writer.write(self.connections[topic], stamp_ns, data)
        self.sequence += 1

    def image(self, topic: str, stamp_ns: int, pixels: NDArray[Any], encoding: str,
              frame: str = "cam", padding: int = 0) -> None:
        rows = np.ascontiguousarray(pixels).view(np.uint8).reshape(len(pixels), -1)
        rows = np.pad(rows, ((0, 0), (0, padding)))
        self.write(topic, "sensor_msgs/msg/Image", stamp_ns, header=self.header(stamp_ns, frame),
                   height=pixels.shape[0], width=pixels.shape[1], encoding=encoding,
                   is_bigendian=0, step=rows.shape[1], data=rows.reshape(-1))

    def info(self, topic: str, stamp_ns: int, camera: pg.Camera, baseline_m: float = 0,
             frame: str = "cam", distortion: tuple[float, ...] = (),
             model: str = "plumb_bob", R: NDArray[np.float64] | None = None) -> None:
        """`baseline_m`: how far the camera stands to the right of the frame of P."""
        K = np.asarray(camera.K(), np.float64)
        P = np.c_[K, [-camera.fx * baseline_m, 0, 0]]
        values = {"d": np.array(distortion, np.float64), "k": K.reshape(-1),
                  "r": (np.eye(3) if R is None else R).reshape(-1), "p": P.reshape(-1)}
        roi = self.make("sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0, height=0,
                        width=0, do_rectify=False)
        self.write(topic, "sensor_msgs/msg/CameraInfo", stamp_ns,
                   header=self.header(stamp_ns, frame), height=camera.height, width=camera.width,
                   distortion_model=model, binning_x=0, binning_y=0, roi=roi,
                   **{name.upper() if self.ros1 else name: v for name, v in values.items()})

    def vector(self, values: Any) -> Any:
        return self.make("geometry_msgs/msg/Vector3", **dict(zip("xyz", map(float, values))))

    def quaternion(self, pose: pg.SE3) -> Any:
        return self.make("geometry_msgs/msg/Quaternion",
                         **dict(zip("xyzw", map(float, pose.quaternion_xyzw))))

    def pose(self, topic: str, stamp_ns: int, matrix: NDArray[np.float64]) -> None:
        T = pg.SE3(matrix)
        point = self.make("geometry_msgs/msg/Point", **dict(zip("xyz", map(float, T.translation))))
        self.write(topic, "geometry_msgs/msg/PoseStamped", stamp_ns,
                   header=self.header(stamp_ns, "world"),
                   pose=self.make("geometry_msgs/msg/Pose", position=point,
                                  orientation=self.quaternion(T)))

    def transform(self, topic: str, stamp_ns: int, parent: str, child: str,
                  matrix: NDArray[np.float64]) -> None:
        T = pg.SE3(matrix)
        transform = self.make("geometry_msgs/msg/Transform", translation=self.vector(T.translation),
                              rotation=self.quaternion(T))
        each = self.make("geometry_msgs/msg/TransformStamped",
                         header=self.header(stamp_ns, parent), child_frame_id=child,
                         transform=transform)
        self.write(topic, "tf2_msgs/msg/TFMessage", stamp_ns, transforms=[each])

    def imu(self, topic: str, stamp_ns: int, gyro: Any, accel: Any) -> None:
        zero = np.zeros(9)
        self.write(topic, "sensor_msgs/msg/Imu", stamp_ns, header=self.header(stamp_ns, "imu"),
                   orientation=self.quaternion(pg.SE3()), orientation_covariance=zero,
                   angular_velocity=self.vector(gyro), angular_velocity_covariance=zero,
                   linear_acceleration=self.vector(accel), linear_acceleration_covariance=zero)


def frames_of(path: pathlib.Path, sensor: pg.Sensor, count: int = 6) -> tuple[Any, list[Any]]:
    dataset = pg.open_dataset(str(path))
    return dataset, [dataset.frame(i, sensor) for i in range(count)]


def stamp(i: int) -> int:
    return BEGIN_NS + i * STEP_NS


@pytest.mark.parametrize("kind", KINDS)
def test_rectified_pair(kind: str, drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.STEREO)
    calibration = dataset.calibration(pg.Sensor.STEREO)
    truth = dataset.ground_truth
    with BagWriter(tmp_path, kind) as bag:
        for i, frame in enumerate(frames):
            for side, pixels in (("left", frame.image), ("right", frame.right)):
                baseline_m = calibration.baseline_m if side == "right" else 0
                bag.info(f"/{side}/camera_info", stamp(i), calibration.camera, baseline_m, side)
                bag.image(f"/{side}/image_rect", stamp(i), pixels, "mono8", side, padding=3)
            bag.pose("/truth", stamp(i), truth.poses[i])
    result = convert(bag.path, tmp_path / "sequence")
    assert (result.layout, result.frames) == ("kitti", 6)

    read, converted = frames_of(tmp_path / "sequence", pg.Sensor.STEREO)
    assert read.calibration(pg.Sensor.STEREO).baseline_m == pytest.approx(calibration.baseline_m)
    for i, (before, after) in enumerate(zip(frames, converted)):
        assert np.array_equal(before.image, after.image)
        assert np.array_equal(before.right, after.right)
        assert after.stamp_ns - converted[0].stamp_ns == i * STEP_NS
    np.testing.assert_allclose(read.ground_truth.poses, truth.poses[:6], atol=1e-8)


@pytest.mark.parametrize("kind", KINDS)
def test_depth(kind: str, drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.RGBD)
    camera = dataset.calibration(pg.Sensor.RGBD).camera
    with BagWriter(tmp_path, kind) as bag:
        for i, frame in enumerate(frames):
            for topic in ("/camera/color", "/camera/depth"):
                bag.info(f"{topic}/camera_info", stamp(i), camera)
            colour = np.stack([frame.image, frame.image // 2, frame.image // 4], axis=2)
            bag.image("/camera/color/image_raw", stamp(i), colour, "rgb8")
            if kind == "sqlite":
                bag.image("/camera/depth/image_raw", stamp(i), frame.depth.copy(), "32FC1")
            else:
                steps = np.rint(frame.depth * 1000).astype(np.uint16)
                bag.image("/camera/depth/image_raw", stamp(i), steps, "16UC1")
            bag.pose("/ground_truth/pose", stamp(i), dataset.ground_truth.poses[i])
    result = convert(bag.path, tmp_path / "sequence")
    assert (result.layout, result.frames) == ("tum", 6)

    read, converted = frames_of(tmp_path / "sequence", pg.Sensor.RGBD)
    for before, after in zip(frames, converted):
        assert np.array_equal(after.colour[:, :, 2], before.image)  # red of BGR
        assert np.array_equal(after.colour[:, :, 0], before.image // 4)
        np.testing.assert_allclose(after.depth, np.rint(before.depth * 1000) / 1000, atol=1e-6)
    np.testing.assert_allclose(read.ground_truth.poses, dataset.ground_truth.poses[:6], atol=1e-7)
    assert converted[3].stamp_ns == stamp(3)


@pytest.mark.parametrize("kind", KINDS)
def test_inertial_and_mounted_camera(kind: str, drive: pathlib.Path,
                                     tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.MONO)
    camera = dataset.calibration(pg.Sensor.MONO).camera
    T_imu_cam = pg.SE3.exp(np.array([0.1, -0.2, 0.05, 0.3, -0.1, 0.2])).matrix()
    with BagWriter(tmp_path, kind) as bag:
        bag.transform("/tf_static", stamp(0), "imu", "cam", T_imu_cam)
        for i, frame in enumerate(frames):
            bag.info("/cam0/camera_info", stamp(i), camera)
            bag.image("/cam0/image_raw", stamp(i), frame.image, "mono8")
            T_world_imu = dataset.ground_truth.poses[i] @ np.linalg.inv(T_imu_cam)
            bag.transform("/tf", stamp(i), "world", "imu", T_world_imu)
            for k in range(4):
                bag.imu("/imu0", stamp(i) + k * STEP_NS // 4, (0.1, i, k), (k, i, 9.8))
    result = convert(bag.path, tmp_path / "sequence", Topics(truth="tf:world:imu"))
    assert (result.layout, result.frames) == ("euroc", 6)

    read, converted = frames_of(tmp_path / "sequence", pg.Sensor.MONO)
    for before, after in zip(frames, converted):
        assert np.array_equal(before.image, after.image)
    np.testing.assert_allclose(read.ground_truth.poses, dataset.ground_truth.poses[:6], atol=1e-8)
    rows = np.loadtxt(tmp_path / "sequence" / "mav0" / "imu0" / "data.csv", delimiter=",")
    assert rows.shape == (24, 7)
    np.testing.assert_allclose(rows[6, 1:], [0.1, 1, 2, 2, 1, 9.8])
    assert any("noise" in note for note in result.notes)


def test_distorted_pair_is_rectified(drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.STEREO)
    calibration = dataset.calibration(pg.Sensor.STEREO)
    with BagWriter(tmp_path, "mcap") as bag:
        for i, frame in enumerate(frames):
            for side, pixels in (("left", frame.image), ("right", frame.right)):
                bag.info(f"/{side}/camera_info", stamp(i), calibration.camera,
                         calibration.baseline_m if side == "right" else 0, side,
                         distortion=(-0.1, 0.02, 0, 0, 0))
                bag.image(f"/{side}/image_raw", stamp(i), pixels, "mono8", side)
    assert convert(bag.path, tmp_path / "sequence").layout == "euroc"
    text = (tmp_path / "sequence" / "mav0" / "cam1" / "sensor.yaml").read_text()
    assert "radial-tangential" in text and "-0.1, 0.02" in text
    read = pg.open_dataset(str(tmp_path / "sequence")).calibration(pg.Sensor.STEREO)
    assert read.baseline_m == pytest.approx(calibration.baseline_m, rel=1e-6)


def rotation(axis_angle: Any) -> NDArray[np.float64]:
    return pg.SE3.exp(np.array([0, 0, 0, *axis_angle])).matrix()[:3, :3]


@pytest.mark.parametrize("seed", range(30))
def test_mounting_of_a_turned_pair(seed: int) -> None:
    """By R and P of camera_info: x_rectified = R x, and each camera stands on the x axis of the
    frame of P, which neither need be in."""
    from placegraph.bag.convert import _T_left_right
    from placegraph.bag.layouts import Images, Recording
    from placegraph.bag.messages import CameraModel

    random = np.random.default_rng(seed)
    turns = [rotation(random.uniform(-0.05, 0.05, 3)) for _ in "lr"]
    left_m, baseline_m = random.uniform(-0.5, 0.5), random.uniform(0.05, 1)
    fx = random.uniform(200, 900)
    K = np.array([[fx, 0, 160], [0, fx, 120], [0, 0, 1]])
    models = [CameraModel("", 320, 240, "plumb_bob", [0.1, 0, 0, 0], K, R,
                          np.c_[K, K @ [-at_m, 0, 0]])
              for R, at_m in zip(turns, (left_m, left_m + baseline_m))]
    recording = Recording(Images("l"), Images("r"), cameras=dict(zip("lr", models)))
    assert recording.baseline_m == pytest.approx(baseline_m)
    T = _T_left_right(recording, None)
    point = random.uniform((-1, -1, 3), (1, 1, 9))  # in the frame of P
    left = turns[0].T @ (point - [left_m, 0, 0])
    right = turns[1].T @ (point - [left_m + baseline_m, 0, 0])
    np.testing.assert_allclose(T[:3, :3] @ right + T[:3, 3], left, atol=1e-12)


def write_pair(bag: BagWriter, drive: pathlib.Path, left_m: float, name: str = "image_rect",
               R: NDArray[np.float64] | None = None) -> float:
    """The frames of a drive, whose left camera stands so far to the right of the frame of P;
    returns the baseline [m]."""
    dataset, frames = frames_of(drive, pg.Sensor.STEREO)
    calibration = dataset.calibration(pg.Sensor.STEREO)
    for i, frame in enumerate(frames):
        for side, pixels, at_m in (("left", frame.image, left_m),
                                   ("right", frame.right, left_m + calibration.baseline_m)):
            bag.info(f"/{side}/camera_info", stamp(i), calibration.camera, at_m, side, R=R)
            bag.image(f"/{side}/{name}", stamp(i), pixels, "mono8", side)
    return float(calibration.baseline_m)


def test_pair_beside_the_frame_of_its_projections(drive: pathlib.Path,
                                                  tmp_path: pathlib.Path) -> None:
    """As KITTI's colour cameras, whose P is in the frame of a third one."""
    with BagWriter(tmp_path, "mcap") as bag:
        baseline_m = write_pair(bag, drive, -0.06)
    result = convert(bag.path, tmp_path / "sequence")
    assert result.layout == "kitti"
    read = pg.open_dataset(str(tmp_path / "sequence"))
    assert read.calibration(pg.Sensor.STEREO).baseline_m == pytest.approx(baseline_m, rel=1e-9)


def test_pair_that_was_rectified_by_its_R(drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    with BagWriter(tmp_path, "mcap") as bag:
        baseline_m = write_pair(bag, drive, 0, "image_raw", rotation((0.01, -0.02, 0.005)))
    result = convert(bag.path, tmp_path / "sequence")
    assert result.layout == "kitti"
    for side in ("left", "right"):
        assert any(f"/{side}/camera_info" in note and "1.31 deg, is not applied" in note
                   for note in result.notes)
    read, converted = frames_of(tmp_path / "sequence", pg.Sensor.STEREO)
    assert read.calibration(pg.Sensor.STEREO).baseline_m == pytest.approx(baseline_m)
    assert np.array_equal(converted[0].right, frames_of(drive, pg.Sensor.STEREO)[1][0].right)


@pytest.mark.parametrize("factor, says", [(1, False), (1.02, False), (1.2, True), (-1, True)])
def test_static_transforms_are_compared_with_the_baseline(
        factor: float, says: bool, drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    with BagWriter(tmp_path, "mcap") as bag:
        baseline_m = write_pair(bag, drive, -0.06)
        T_left_right = np.eye(4)
        T_left_right[0, 3] = factor * baseline_m
        bag.transform("/tf_static", stamp(0), "left", "right", T_left_right)
    notes = convert(bag.path, tmp_path / "sequence").notes
    assert any("by camera_info, which is taken" in note for note in notes) == says


def test_named_depth_has_priority(drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.RGBD)
    camera = dataset.calibration(pg.Sensor.RGBD).camera
    with BagWriter(tmp_path, "ros1") as bag:
        for i, frame in enumerate(frames):
            for name, pixels in (("infra1", frame.image), ("infra2", frame.image)):
                bag.info(f"/{name}/camera_info", stamp(i), camera, 0.1 * (name == "infra2"))
                bag.image(f"/{name}/image_rect_raw", stamp(i), pixels, "mono8")
            bag.info("/depth/camera_info", stamp(i), camera)
            bag.image("/depth/image", stamp(i), np.rint(frame.depth * 1000).astype(np.uint16),
                      "mono16")
    pair = convert(bag.path, tmp_path / "pair")
    assert pair.layout == "kitti" and any("/depth/image" in note for note in pair.notes)
    named = convert(bag.path, tmp_path / "depth", Topics(depth="/depth/image"))
    assert named.layout == "tum"
    assert pg.open_dataset(str(tmp_path / "depth")).sensors[0] == pg.Sensor.RGBD


def test_compressed_images_keep_their_bytes(drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.MONO)
    with BagWriter(tmp_path, "ros1") as bag:
        for i, frame in enumerate(frames):
            file = tmp_path / "image.png"
            _core.write_image(str(file), np.ascontiguousarray(frame.image))
            bag.info("/cam/camera_info", stamp(i), dataset.calibration(pg.Sensor.MONO).camera)
            bag.write("/cam/image_raw/compressed", "sensor_msgs/msg/CompressedImage", stamp(i),
                      header=bag.header(stamp(i), "cam"), format="mono8; png compressed",
                      data=np.frombuffer(file.read_bytes(), np.uint8))
    convert(bag.path, tmp_path / "sequence")
    _, converted = frames_of(tmp_path / "sequence", pg.Sensor.MONO)
    for before, after in zip(frames, converted):
        assert np.array_equal(before.image, after.image)


def test_given_calibration(drive: pathlib.Path, tmp_path: pathlib.Path) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.MONO)
    camera = dataset.calibration(pg.Sensor.MONO).camera
    with BagWriter(tmp_path, "sqlite") as bag:
        for i, frame in enumerate(frames):
            bag.image("/cam/image_raw", stamp(i), frame.image, "8UC1")
            bag.pose("/vicon/body", stamp(i) + 7, dataset.ground_truth.poses[i])
    calibration = tmp_path / "given.yaml"
    calibration.write_text(f"width: {camera.width}\nheight: {camera.height}\nfx: {camera.fx}\n"
                           f"fy: {camera.fy}\ncx: {camera.cx}\ncy: {camera.cy}\n")
    with pytest.raises(pg.ArgumentError, match="camera_info.*; calibration gives"):
        convert(bag.path, tmp_path / "sequence")
    with pytest.raises(pg.ArgumentError, match="image /x: .*list_topics"):
        convert(bag.path, tmp_path / "sequence", Topics(image="/x"), calibration=calibration)
    assert not (tmp_path / "sequence").exists()
    result = convert(bag.path, tmp_path / "sequence", calibration=calibration)
    assert (result.layout, result.frames) == ("images", 6)
    read, converted = frames_of(tmp_path / "sequence", pg.Sensor.MONO)
    assert np.array_equal(converted[5].image, frames[5].image)
    # Between two poses there is one; before the first there is none.
    assert read.ground_truth.posed == 5
    np.testing.assert_allclose(read.ground_truth.poses[2], dataset.ground_truth.poses[2], atol=1e-6)


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
def test_bayer_of_one_colour(pattern: str) -> None:
    levels = {"r": 200, "g": 100, "b": 50}
    cell = np.array([levels[c] for c in pattern], np.uint8).reshape(2, 2)
    colour = _core.demosaic(np.tile(cell, (8, 8)), pattern)
    assert colour.shape == (16, 16, 3)
    assert np.array_equal(colour[4:12, 4:12].reshape(-1, 3), np.tile([50, 100, 200], (64, 1)))


def test_command(drive: pathlib.Path, tmp_path: pathlib.Path,
                 capsys: pytest.CaptureFixture[str]) -> None:
    dataset, frames = frames_of(drive, pg.Sensor.MONO)
    with BagWriter(tmp_path, "mcap") as bag:
        for i, frame in enumerate(frames):
            bag.info("/cam/camera_info", stamp(i), dataset.calibration(pg.Sensor.MONO).camera)
            bag.image("/cam/image_raw", stamp(i), frame.image, "mono8")
    out = tmp_path / "sequence"
    assert list_topics([bag.path])["/cam/image_raw"] == ("sensor_msgs/msg/Image", 6)
    assert main([str(bag.path), "--list"]) == 0
    assert "/cam/camera_info  sensor_msgs/msg/CameraInfo  6" in capsys.readouterr().out
    lone = next(bag.path.glob("*.mcap"))
    assert main([str(lone), "--out", str(out)]) == 0
    assert f"{out}: 6 frames, euroc" in capsys.readouterr().out
    assert main([str(bag.path), "--out", str(out)]) == 2
    assert "--force" in capsys.readouterr().err
    with pytest.raises(pg.ArgumentError, match="force=True replaces it"):
        convert(bag.path, out)
    assert main([str(bag.path), "--out", str(out), "--force"]) == 0
    help_text = subprocess.run([sys.executable, "-m", "placegraph.bag", "--help"], check=True,
                               capture_output=True, text=True).stdout
    assert "--truth" in help_text


def damaged(tmp_path: pathlib.Path, kind: str) -> pathlib.Path:
    """A bag whose file is cut short."""
    with BagWriter(tmp_path, kind) as bag:
        for i in range(20):
            bag.image("/cam/image_raw", stamp(i), np.zeros((64, 64), np.uint8), "mono8")
    file = bag.path if kind == "ros1" else next(
        path for path in bag.path.iterdir() if path.suffix in (".db3", ".mcap"))
    file.write_bytes(file.read_bytes()[:len(file.read_bytes()) // 2])
    return bag.path


def write_image(value: Callable[[BagWriter], None]) -> Callable[[pathlib.Path], pathlib.Path]:
    def make(tmp_path: pathlib.Path) -> pathlib.Path:
        with BagWriter(tmp_path, "ros1") as bag:
            bag.info("/cam/camera_info", stamp(0), pg.Camera(8, 8, 8, 8, 4, 4))
            value(bag)
        return bag.path
    return make


WRONG: list[tuple[str, Callable[[pathlib.Path], pathlib.Path], list[str], str]] = [
    ("missing", lambda path: path / "none.bag", [], "no such bag"),
    ("text", lambda path: _text(path / "text.bag"), [], "text.bag"),
    ("text_mcap", lambda path: _text(path / "text.mcap"), [], "text.mcap"),
    ("other_suffix", lambda path: _text(path / "bag.txt"), [], "bag.txt"),
    *((f"cut_{kind}", lambda path, kind=kind: damaged(path, kind),
       ["--calib", "calib.yaml"], "bag") for kind in KINDS),
    ("no_images", write_image(lambda bag: None), [], "no images"),
    ("unknown_topic", write_image(lambda bag: None), ["--image", "/x"], "--image /x"),
    ("encoding", write_image(lambda bag: bag.image(
        "/cam/image_raw", stamp(0), np.zeros((8, 16), np.uint8), "yuv422")), [], "yuv422"),
    ("short_data", write_image(lambda bag: bag.write(
        "/cam/image_raw", "sensor_msgs/msg/Image", stamp(0), header=bag.header(stamp(0), ""),
        height=8, width=8, encoding="mono8", is_bigendian=0, step=8,
        data=np.zeros(5, np.uint8))), [], "has 5 bytes"),
    ("truth_type", write_image(lambda bag: bag.image(
        "/cam/image_raw", stamp(0), np.zeros((8, 8), np.uint8), "mono8")),
     ["--truth", "/cam/image_raw"], "is no pose"),
    ("truth_frames", write_image(lambda bag: bag.image(
        "/cam/image_raw", stamp(0), np.zeros((8, 8), np.uint8), "mono8")),
     ["--truth", "tf:a"], "tf:PARENT:CHILD"),
    ("no_folder", lambda path: path / "bag.bag", ["--out", "none/sequence"], "no folder"),
]


def _text(path: pathlib.Path) -> pathlib.Path:
    path.write_text("this is no bag\n" * 40)
    return path


@pytest.mark.parametrize("make, options, text", [case[1:] for case in WRONG],
                         ids=[case[0] for case in WRONG])
def test_bad_input_is_one_line(make: Callable[[pathlib.Path], pathlib.Path], options: list[str],
                               text: str, tmp_path: pathlib.Path,
                               monkeypatch: pytest.MonkeyPatch,
                               capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "calib.yaml").write_text("width: 64\nheight: 64\nfx: 64\nfy: 64\ncx: 32\ncy: 32\n")
    bag = make(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    assert main([str(bag), "--out", str(tmp_path / "sequence"), *options]) == 2
    error = capsys.readouterr().err
    assert text in error and error.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("kind", KINDS)
def test_a_topic_of_poses_is_a_trajectory(kind: str, tmp_path: pathlib.Path) -> None:
    poses = np.tile(np.eye(4), (5, 1, 1))
    poses[:, 0, 3] = np.arange(5)
    with BagWriter(tmp_path, kind) as bag:
        for i in (0, 2, 1, 3, 4):  # messages of a bag need not be in order
            bag.pose("/estimate", stamp(i), poses[i])
            bag.transform("/tf", stamp(i), "world", "body", poses[i])
            bag.transform("/tf", stamp(i), "body", "cam", np.eye(4))
        bag.pose("/twice", stamp(0), poses[0])
        bag.pose("/twice", stamp(1), poses[1])
        bag.pose("/twice", stamp(1), poses[3])
        bag.imu("/imu", stamp(0), np.zeros(3), np.zeros(3))
    for topic in ("/estimate", "tf:world:body"):
        read = read_trajectory(bag.path, topic)
        np.testing.assert_array_equal(read.stamps_ns, [stamp(i) for i in range(5)])
        np.testing.assert_allclose(read.poses, poses, atol=1e-12)
    with pytest.warns(pg.Doubt, match="the stamp stands twice"):
        assert read_trajectory(bag.path, "/twice").poses[1][0, 3] == 1
    for topic, message in (("/imu", "sensor_msgs/msg/Imu has no poses"), ("tf:world", "PARENT"),
                           ("/none", "no such topic; of poses are /estimate, /twice"),
                           ("tf:world:wheel", "has no poses in the bag")):
        with pytest.raises(pg.ArgumentError, match=message):
            read_trajectory(bag.path, topic)
