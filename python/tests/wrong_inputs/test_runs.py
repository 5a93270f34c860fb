"""Wrong inputs of slam, datasets and rendering: each raises, and the text names the argument."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from checks import wrong
from numpy.typing import NDArray

import placegraph as pg

Image = NDArray[np.uint8]
Case = tuple[str, Callable[..., object], Any, str]

GREY = np.zeros((240, 320), np.uint8)
DEPTH = np.ones((240, 320), np.float32)
CAMERA = pg.Camera(320, 240, 300, 300, 160, 120)
CALIBRATION = pg.Calibration(CAMERA)


def mono() -> pg.Slam:
    return pg.Slam(pg.Calibration(CAMERA))


def stereo() -> pg.Slam:
    return pg.Slam(pg.Calibration(CAMERA, baseline_m=0.1))


@pytest.fixture(scope="module")
def sequence(tmp_path_factory: pytest.TempPathFactory) -> pg.Dataset:
    folder = tmp_path_factory.mktemp("wrong") / "sequence"
    return pg.synthetic.render("corridor-loop", folder, frames=3, size=(160, 120))


def after_one(stamp: float) -> None:
    slam = mono()
    slam.add_frame(GREY, 1.0)
    slam.add_frame(GREY, stamp)


class NoQuery:
    def clear(self) -> None:
        pass

    def add(self, image: Image) -> None:
        pass


def motion(**changed: Any) -> pg.MeasuredMotion:
    arguments: dict[str, Any] = {"from_ns": [0, 1], "to_ns": [1, 2], "T_from_to": np.tile(np.eye(4), (2, 1, 1)),
                 "covariance": np.tile(np.eye(6), (2, 1, 1))}
    return pg.MeasuredMotion.from_arrays(**{**arguments, **changed})


def world(**changed: Any) -> pg.synthetic.World:
    arguments: dict[str, Any] = {"world": "corridor-loop", "frames": 2, "size": (64, 48)}
    return pg.synthetic.World(**{**arguments, **changed})


ADD_FRAME: list[Case] = [
    ("float image", lambda: mono().add_frame(GREY.astype(float), 0.0), ValueError, "image"),
    ("colour as image", lambda: mono().add_frame(np.zeros((240, 320, 3), np.uint8), 0.0),
     ValueError, "image"),
    ("line as image", lambda: mono().add_frame(np.zeros(320, np.uint8), 0.0), ValueError, "image"),
    ("list as image", lambda: mono().add_frame(wrong([[1, 2], [3, 4]]), 0.0), ValueError, "image"),
    ("None as image", lambda: mono().add_frame(wrong(None), 0.0), ValueError, "image"),
    ("empty image", lambda: mono().add_frame(GREY[:0], 0.0), ValueError, "image"),
    ("other size", lambda: mono().add_frame(GREY[:100], 0.0), ValueError, "320x240"),
    ("every other column", lambda: mono().add_frame(np.zeros((240, 640), np.uint8)[:, ::2], 0.0),
     ValueError, "image: its rows must be contiguous"),
    ("columns first", lambda: mono().add_frame(np.asfortranarray(GREY), 0.0), ValueError,
     "image: its rows must be contiguous"),
    ("rows upwards", lambda: mono().add_frame(GREY[::-1], 0.0), ValueError, "image"),
    ("no stamp", lambda: mono().add_frame(GREY), ValueError, "stamp"),
    ("stamp NaN", lambda: mono().add_frame(GREY, float("nan")), ValueError, "stamp"),
    ("stamp infinite", lambda: mono().add_frame(GREY, float("inf")), ValueError, "stamp"),
    ("stamp in ns", lambda: mono().add_frame(GREY, 1.7e18), ValueError, "stamp"),
    ("stamp text", lambda: mono().add_frame(GREY, wrong("1")), TypeError, "stamp"),
    ("stamp repeated", lambda: after_one(1.0), ValueError, "stamps must increase"),
    ("stamp earlier", lambda: after_one(0.5), ValueError, "stamps must increase"),
    ("right of other size", lambda: stereo().add_frame(GREY, 0.0, right=GREY[:100]), ValueError,
     "right"),
    ("right float", lambda: stereo().add_frame(GREY, 0.0, right=wrong(DEPTH)), ValueError, "right"),
    ("depth uint16", lambda: mono().add_frame(GREY, 0.0, depth=GREY.astype(np.uint16)), ValueError,
     "depth"),
    ("depth float64", lambda: mono().add_frame(GREY, 0.0, depth=DEPTH.astype(float)), ValueError,
     "depth"),
    ("colour grey", lambda: mono().add_frame(GREY, 0.0, colour=GREY), ValueError, "colour"),
    ("colour of other size",
     lambda: mono().add_frame(GREY, 0.0, colour=np.zeros((100, 320, 3), np.uint8)), ValueError,
     "colour"),
    ("mask bool", lambda: mono().add_frame(GREY, 0.0, mask=wrong(GREY > 0)), ValueError, "mask"),
    ("mask of other size", lambda: mono().add_frame(GREY, 0.0, mask=GREY[:9]), ValueError, "mask"),
]

OBJECTS: list[Case] = [
    ("no calibration", lambda: pg.Slam(wrong(None)), TypeError, "calibration"),
    ("options of a run", lambda: pg.Slam(CALIBRATION, wrong(pg.RunOptions())), ValueError,
     "options"),
    ("options as a dictionary", lambda: pg.Slam(CALIBRATION, wrong({"a": 1})), ValueError,
     "options: SlamOptions"),
    ("event function", lambda: pg.Slam(CALIBRATION, on_event=wrong(3)), ValueError, "on_event"),
    ("log function", lambda: pg.Slam(CALIBRATION, on_log=wrong("x")), ValueError, "on_log"),
    ("motion as array", lambda: pg.Slam(CALIBRATION, motion=wrong(np.eye(4))), TypeError,
     "motion"),
    ("surfaces of no file", lambda: pg.Slam(CALIBRATION, surfaces="/none.pgscene"),
     OSError, "/none.pgscene"),
    ("recognizer without query", lambda: pg.Slam(CALIBRATION, recognizer=wrong(NoQuery())),
     ValueError, "recognizer: it has no method query"),
    ("recognizer number", lambda: pg.Slam(CALIBRATION, recognizer=wrong(3)), ValueError,
     "recognizer"),
    ("finish twice", lambda: [slam.finish() for slam in [mono()] * 2], ValueError, "called twice"),
    ("resume with no map", lambda: mono().resume(wrong(None), wrong(None)), ValueError, "map"),
    ("motion order", lambda: motion(from_ns=[1, 0]), ValueError, "step"),
    ("motion length", lambda: motion(to_ns=[1]), ValueError, "to_ns"),
    ("motion shape", lambda: motion(T_from_to=np.eye(4)), ValueError, "T_from_to"),
    ("motion no rotation", lambda: motion(T_from_to=2 * np.ones((2, 4, 4))), ValueError,
     "T_from_to"),
    ("motion NaN", lambda: motion(covariance=np.full((2, 6, 6), np.nan)), ValueError, "covariance"),
    ("motion times float", lambda: motion(from_ns=[0.5, 1.5]), ValueError, "from_ns"),
    ("motion empty", lambda: motion(from_ns=[], to_ns=[], T_from_to=np.zeros((0, 4, 4)),
                                    covariance=np.zeros((0, 6, 6))), ValueError, "step"),
    ("no world", lambda: world(world="moon-loop"), ValueError, "moon-loop"),
    ("difficulty", lambda: world(difficulty="easy"), ValueError, "difficulty"),
    ("size negative", lambda: world(size=(-1, 10)), ValueError, "size"),
    ("size small", lambda: world(size=(8, 8)), ValueError, "size"),
    ("frames negative", lambda: world(frames=-1), ValueError, "frames"),
    ("seed negative", lambda: world(seed=-1), TypeError, "seed"),
    ("duration of no flight", lambda: world(duration_s=3), ValueError, "duration_s"),
    ("frame negative", lambda: world().render(-1), ValueError, "index"),
    ("frame beyond", lambda: world().render(2), ValueError, "index"),
    ("sensor text", lambda: world().render(0, wrong("radar")), ValueError, "sensor"),
    ("threads", lambda: world().write("/tmp/none", threads=-2), ValueError, "threads"),
]

DATASETS: list[Case] = [
    ("no folder", lambda d: pg.open_dataset("/does/not/exist"), OSError, "/does/not/exist"),
    ("number as path", lambda d: pg.open_dataset(wrong(3)), TypeError, "PathLike"),
    ("index beyond", lambda d: d.frame(3), ValueError, "3"),
    ("index negative", lambda d: d.frame(-1), ValueError, "index"),
    ("index float", lambda d: d.frame(wrong(0.5)), TypeError, "index"),
    ("step zero", lambda d: d.frames(step=0), ValueError, "step"),
    ("sensor as text", lambda d: d.frame(0, wrong("radar")), ValueError, "mono, stereo, rgbd"),
    ("sensor as number", lambda d: d.frame(0, wrong(1)), ValueError, "sensor"),
    ("item beyond", lambda d: d[3], IndexError, "index"),
    ("item before", lambda d: d[-4], IndexError, "index"),
    ("item of text", lambda d: d[wrong("0")], TypeError, "str"),
    ("frame with a stamp", lambda d: mono().add_frame(d[0], 99.0), ValueError, "stamp"),
    ("frame with a depth", lambda d: mono().add_frame(d[0], depth=DEPTH), ValueError, "depth"),
    ("frame with a mask", lambda d: mono().add_frame(d[0], mask=GREY), ValueError, "mask"),
    ("options as a dictionary", lambda d: pg.run(d, wrong({"threads": 1})), ValueError,
     "options: RunOptions"),
    ("empty options", lambda d: pg.run(d, wrong({})), ValueError, "options: RunOptions"),
    ("missing sensor", lambda d: d.frame(0, pg.Sensor.STEREO), ValueError, "stereo"),
    ("calibration of a missing sensor", lambda d: d.calibration(pg.Sensor.STEREO), ValueError,
     "stereo"),
    ("options of Slam for run", lambda d: pg.run(d, wrong(pg.SlamOptions())), ValueError, "options"),
    ("resume without a file", lambda d: pg.run(d, resume=True), ValueError, "resume"),
    ("resume of no file", lambda d: pg.run(d, map_file="/does/not/exist.db", resume=True), OSError,
     "/does/not/exist.db"),
    ("map file in no folder", lambda d: pg.run(d, map_file="/does/not/exist.db"), OSError,
     "/does/not/exist.db"),
    ("stop is no function", lambda d: pg.run(d, stop=wrong(True)), ValueError, "stop"),
    ("on_frame is no function", lambda d: pg.run(d, on_frame=wrong(1)), ValueError, "on_frame"),
    ("resume with another camera", lambda d: mono().resume(pg.run(d), d.frame(0)), ValueError,
     "320x240"),
    ("folder with content", lambda d: pg.synthetic.render("corridor-loop", d.path, frames=1),
     ValueError, "sequence"),
]


@pytest.mark.parametrize("name, call, error, text", ADD_FRAME + OBJECTS)
def test_wrong_input(name: str, call: Callable[..., object], error: type[Exception],
                     text: str) -> None:
    with pytest.raises(error, match=text):
        call()


@pytest.mark.parametrize("name, call, error, text", DATASETS)
def test_wrong_input_of_sequences(sequence: pg.Dataset, name: str, call: Callable[..., object],
                                  error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        call(sequence)
