"""Wrong geometry, trajectories and options: an exception that names the argument."""

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import placegraph as pg

ONE = np.eye(4)[None]
NOT_FINITE = np.full((4, 4), np.inf)
WRONG: Any = None
WIDE: Any = "wide"


def options(path: str, value: Any) -> Callable[[], None]:
    def assign() -> None:
        group, _, name = path.rpartition(".")
        target: Any = pg.RunOptions()
        for part in filter(None, group.split(".")):
            target = getattr(target, part)
        setattr(target, name, value)

    return assign


def trajectory(stamps: Any, poses: Any) -> Callable[[], pg.Trajectory]:
    return lambda: pg.Trajectory.from_arrays(stamps, poses)


CASES: list[tuple[str, Callable[[], Any], type[Exception], str]] = [
    ("matrix of another shape", lambda: pg.SE3(np.eye(3)), ValueError, "matrix"),
    ("matrix of text", lambda: pg.SE3([["a"] * 4] * 4), ValueError, "matrix"),
    ("matrix of complex numbers", lambda: pg.SE3(np.eye(4) * 1j), ValueError, "matrix"),
    ("matrix that is not finite", lambda: pg.SE3(NOT_FINITE), ValueError, "matrix"),
    ("matrix of rows of different lengths", lambda: pg.SE3([[1], [1, 2]]), ValueError, "matrix"),
    ("matrix that mirrors", lambda: pg.SE3(np.diag([1.0, 1, -1, 1])), ValueError, ""),
    ("matrix whose last row is another", lambda: pg.SE3(np.ones((4, 4))), ValueError, "matrix"),
    ("matrix that is None", lambda: pg.SE3(WRONG), TypeError, "matrix"),
    ("quaternion of zeros", lambda: pg.SE3.from_quaternion_xyzw(np.zeros(4), [0, 0, 0]),
     ValueError, "quaternion"),
    ("quaternion of three numbers", lambda: pg.SE3.from_quaternion_wxyz([1, 0, 0], [0, 0, 0]),
     ValueError, "quaternion"),
    ("translation with NaN", lambda: pg.SE3.from_quaternion_wxyz([1, 0, 0, 0], [0, np.nan, 0]),
     ValueError, "translation"),
    ("tangent of seven numbers", lambda: pg.SE3.exp(np.zeros(7)), ValueError, "xi"),
    ("points in two dimensions", lambda: pg.SE3().transform(np.zeros((5, 2))), ValueError, "points"),
    ("camera without a width", lambda: pg.Camera(0, 480, 500, 500, 320, 240), ValueError, "width"),
    ("camera with a negative focal length", lambda: pg.Camera(640, 480, -1, 500, 320, 240),
     ValueError, "fx"),
    ("camera with NaN", lambda: pg.Camera(640, 480, 500, 500, float("nan"), 240), ValueError, "cx"),
    ("camera with too many coefficients",
     lambda: pg.Camera(640, 480, 500, 500, 320, 240, coefficients=[0.0] * 9),
     ValueError, "coefficients"),
    ("camera of text", lambda: pg.Camera(WIDE, 480, 500, 500, 320, 240), TypeError, "width"),
    ("calibration with a negative baseline",
     lambda: pg.Calibration(pg.Camera(640, 480, 500, 500, 320, 240), baseline_m=-1.0),
     ValueError, "baseline"),
    ("stamps of floats", trajectory([0.5], ONE), ValueError, "stamps_ns"),
    ("stamps that go back", trajectory([1, 0], np.tile(ONE, (2, 1, 1))), ValueError,
     "stamps_ns: row 1"),
    ("more stamps than poses", trajectory([1, 2], ONE), ValueError, "poses"),
    ("poses of 3 x 4", trajectory([1], ONE[:, :3]), ValueError, "poses"),
    ("poses that are no rotations", trajectory([1], 2 * ONE), ValueError, "poses: row 0"),
    ("gap of NaN", lambda: pg.Trajectory().pose_at(0, float("nan")), ValueError, "max_gap_s"),
    ("stamps to resample that do not increase", lambda: pg.Trajectory().resample([5, 1]),
     ValueError, "stamps_ns: row 1"),
    ("option that is None", options("threads", None), ValueError, "threads"),
    ("file that is missing", lambda: pg.Trajectory.read("/no/such/file"), OSError, "/no/such/file"),
    ("folder that is missing", lambda: pg.open_dataset("/no/such/folder"), OSError,
     "/no/such/folder"),
    ("help of no option", lambda: pg.RunOptions().help("none"), AttributeError, "none"),
    ("option that does not exist", options("loops.no_such", 1), AttributeError, "loops.no_such"),
    ("group that does not exist", options("no_such.enabled", 1), AttributeError, "no_such"),
    ("option out of its range", options("threads", 0), ValueError, "threads"),
    ("option of another type", options("loops.enabled", 1), ValueError, "loops.enabled"),
    ("option with NaN", options("camera_height_m", float("nan")), ValueError, "camera_height_m"),
    ("integer option of a float", options("threads", 1.5), ValueError, "threads"),
    ("choice that does not exist", options("sensor", "radar"), ValueError, "sensor"),
    ("group that is assigned", options("loops", 3), AttributeError, "loops"),
    ("options that are no YAML", lambda: pg.RunOptions.from_yaml("a: [1"), OSError, "text"),
]


@pytest.mark.parametrize("call, kind, text", [case[1:] for case in CASES],
                         ids=[case[0] for case in CASES])
def test_is_refused_and_named(call: Callable[[], Any], kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as raised:
        call()
    assert text in str(raised.value)


def test_a_file_is_replaced_as_a_whole_or_not_at_all(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "kept.txt"
    file.write_text("kept")
    no_times = tmp_path / "00.txt"
    no_times.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n")
    with pytest.raises(ValueError):
        pg.Trajectory.read(str(no_times)).write(str(file), pg.TrajectoryFormat.TUM)
    assert file.read_text() == "kept"
