"""SLAM of a whole sequence, or of frames that are added one by one."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol, TypeAlias, Union

from . import _core
from ._progress import ProgressArgument, Report, reporting
from ._types import Path
from .datasets import Dataset, open_dataset
from .maps import Map, core_of
from .options import RunOptions, SlamOptions, given_or_default

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Image = NDArray[np.uint8]

Event = Union[
    _core.RunBegan,
    _core.LensFound,
    _core.FrameResult,
    _core.KeyframeAdded,
    _core.LoopRecord,
    _core.PlaceAdded,
    _core.PlacesMerged,
    _core.ComponentJoined,
    _core.MapMoved,
]
"""What `on_event` is called with.

A frame that has a pose or is lost (FrameResult), a new keyframe (KeyframeAdded), a loop candidate
that was accepted or refused (LoopRecord), a new place or two that are one (PlaceAdded,
PlacesMerged), two components that were joined, and places that an optimization moved (MapMoved).
Within add_frame the order is fixed: for each new keyframe KeyframeAdded, its places, its loops and
their effects; last the FrameResult, once for every frame.
"""


OnFrame: TypeAlias = Callable[[int, int, _core.FrameResult], object]


class Recognizer(Protocol):
    """A place recognizer of one's own, which `Slam` and `run` ask for loop candidates.

    They also take a function from an image to a vector (see RecognizerArgument).

    `image` is H x W uint8, or H x W x 3 (BGR) where frames have colour; it is read-only and valid
    after the call, too. Geometry decides which candidates are loops.
    """

    def clear(self) -> None:
        """Forgets all images; called when a run begins."""

    def add(self, image: Image) -> None:
        """Stores an image; its number is that of the images stored before."""

    def query(self, image: Image, first: int, last: int) -> Sequence[tuple[int, float]]:
        """Stored images among first..last that may show the same place, as (number, score).

        They are examined in descending order of their finite scores, which may have any unit.
        Images that do not resemble `image` should not be returned.
        """
        ...


class RunResult(Map):
    """The map of `run`, with what is known of the run itself."""

    def __init__(self, core: _core.Run, path: str = "") -> None:
        super().__init__(core.map, path)
        self._run = core

    @property
    def sensor(self) -> _core.Sensor:
        """Sensor of the run."""
        return self._run.sensor

    @property
    def lens_k1(self) -> float:
        """Radial distortion (k1 of OpenCV's model) that was removed from the images; 0: none."""
        return self._run.lens_k1

    @property
    def broken_off(self) -> str | None:
        """Why a frame could not be read; the map then holds the frames before it. None: all."""
        return self._run.broken_off

    @property
    def stopped(self) -> bool:
        """Whether `stop` ended the run; the map holds the frames before."""
        return self._run.stopped

    @property
    def resumed_at(self) -> int | None:
        """First frame that was processed, if the run resumed an interrupted one."""
        return self._run.resumed_at

    @property
    def stages(self) -> dict[str, tuple[float, int]]:
        """CPU time [s] and calls of reading images and of each stage of Slam."""
        return self._run.stages

    @property
    def unposed(self) -> tuple[tuple[str, int], ...]:
        """Reasons why frames have no pose, with numbers of frames, the most frequent first."""
        return self._run.unposed

    @property
    def notes(self) -> tuple[_core.DataNote, ...]:
        """Doubts about the images, the calibration and the motion that the frames show."""
        return self._run.notes


RecognizerArgument: TypeAlias = "Recognizer | Callable[[Image], ArrayLike] | str"
"""What `Slam` and `run` find the candidates of loops by.

A Recognizer; a function from an image to a vector, its descriptor, of which those of similar images
have a large inner product; or the name of a program, a network or a file of descriptors:
'exec:COMMAND', 'onnx:FILE', 'descriptors:FILE.npy' (docs/recognizers.md). A name starts its program,
as the user of this process.
"""


def run(
    dataset: Dataset | Path,
    options: RunOptions | None = None,
    *,
    map_file: Path | None = None,
    resume: bool = False,
    surfaces: Path | None = None,
    recognizer: RecognizerArgument | None = None,
    on_event: Callable[[Event], object] | None = None,
    on_frame: OnFrame | None = None,
    on_log: Callable[[str, str], object] | None = None,
    stop: Callable[[], bool] | None = None,
    progress: ProgressArgument = None,
) -> RunResult:
    """Runs SLAM on every frame of a sequence (a dataset, or the path of one).

    `map_file`: file in which the map is saved, after every new place and at the end; with `resume`
    the run that was interrupted there goes on. `surfaces`: model of surfaces, which the options
    `semantics` and `context` need. `recognizer`: a place recognizer of one's own, see
    RecognizerArgument; a run that began with one is resumed with one.
    `on_event(event)` is called for every Event, `on_frame(done, total, result)` after every frame,
    `on_log(level, text)` for every message, `stop()` before every frame: True ends the run;
    `progress` counts frames (see Progress). An exception in any of them ends the run and is raised
    here, as KeyboardInterrupt is for Ctrl-C.
    An unreadable frame other than the first one ends the run, too: see RunResult.broken_off. Warns
    with Doubt of each of RunResult.notes.
    """
    opened = dataset if isinstance(dataset, Dataset) else open_dataset(dataset)
    chosen = given_or_default(options, RunOptions)
    path = None if map_file is None else os.fspath(map_file)
    with reporting(progress, "run", "frames") as report:
        done = _core.run(
            opened._core,
            chosen._set,
            opened.path,
            map_file=path,
            resume=resume,
            surfaces=None if surfaces is None else os.fspath(surfaces),
            recognizer=recognizer,
            on_event=on_event,
            on_frame=on_frame if report is None else _reported(report, on_frame),
            on_log=on_log,
            stop=stop,
        )
    for note in done.notes:
        warnings.warn(f"{opened.name}: {note.text}", _core.Doubt, stacklevel=2)
    return RunResult(done, path or "")


def _reported(report: Report, on_frame: OnFrame | None) -> OnFrame:
    """The function that is called after every frame where progress is shown."""
    if on_frame is not None and not callable(on_frame):
        raise _core.ArgumentError(f"on_frame: a function is needed, not {on_frame!r}")

    def after_frame(done: int, total: int, result: _core.FrameResult) -> None:
        report(done, total, result.reason)
        if on_frame is not None:
            on_frame(done, total, result)

    return after_frame


class Slam:
    """Takes frames one by one and estimates the map and the trajectory.

        slam = pg.Slam(calibration)
        for image, stamp in camera:
            result = slam.add_frame(image, stamp)
        m = slam.finish()

    The camera is stereo if the calibration has a baseline, RGB-D if it has a depth camera, and
    monocular otherwise. `motion`: the motion of the (left) camera by other sensors, on the clock of
    the frames. `surfaces`: a model of surfaces, which the options `semantics` and `context` need.
    `recognizer`: see RecognizerArgument. `on_event(event)` is called for every Event,
    `on_log(level, text)` for every message. After an exception in them, and after Ctrl-C, in a call
    that changes the object, every call raises Error. Objects share nothing, so that each thread
    may have one of its own; one object serves one call at a time.
    """

    def __init__(
        self,
        calibration: _core.Calibration,
        options: SlamOptions | None = None,
        *,
        motion: _core.MeasuredMotion | None = None,
        surfaces: Path | None = None,
        recognizer: RecognizerArgument | None = None,
        on_event: Callable[[Event], object] | None = None,
        on_log: Callable[[str, str], object] | None = None,
    ) -> None:
        self._core = _core.SlamCore(
            given_or_default(options, SlamOptions)._set,
            calibration,
            on_event=on_event,
            on_log=on_log,
            motion=motion,
            surfaces=None if surfaces is None else os.fspath(surfaces),
            recognizer=recognizer,
        )

    def add_frame(
        self,
        image: Image | _core.Frame,
        stamp: float | None = None,
        *,
        right: Image | None = None,
        depth: NDArray[np.float32] | None = None,
        colour: Image | None = None,
        mask: Image | None = None,
    ) -> _core.FrameResult:
        """Processes a frame and returns its pose, or why it has none.

        `image`: H x W uint8 of the left or only camera, or a frame of a dataset, which comes alone;
        `stamp` [s], which must increase; `right`: H x W uint8 of the right camera of a rectified
        pair; `depth`: H x W float32 [m], 0 where nothing was measured; `colour`: H x W x 3 uint8
        (BGR); `mask`: H x W uint8, 0 where the image is not used. Arrays are copied: a buffer may
        be used again.
        """
        if isinstance(image, _core.Frame):
            beside = {"stamp": stamp, "right": right, "depth": depth, "colour": colour,
                      "mask": mask}
            for name, value in beside.items():
                if value is not None:
                    raise _core.ArgumentError(f"{name}: a Frame is given, which has its own")
            return self._core.add(image)
        if stamp is None:
            raise _core.ArgumentError("stamp: the time of the image [s] is needed")
        return self._core.add_frame(
            image, stamp, right=right, depth=depth, colour=colour, mask=mask
        )

    def resume(self, map: Map, last: _core.Frame,
               frame_of: Callable[[int], _core.Frame] | None = None) -> None:
        """Goes on with a saved map of an interrupted run; comes before the first frame.

        `last` is the frame of the map's last keyframe; add_frame continues with the one after it.
        A recognizer gets the images of the keyframes again: `frame_of` returns the frame of a
        number, as `dataset.frame`.
        """
        self._core.resume(core_of(map), last, frame_of)

    def view(self) -> _core.FrameView:
        """The tracked features of the last frame, as arrays; empty if that frame is lost."""
        return self._core.view()

    def notes(self) -> list[_core.DataNote]:
        """Doubts that the frames so far raise, each with a cause."""
        return self._core.notes()

    def lens(self) -> _core.LensDistortion:
        """The radial distortion estimated so far; for a stereo pair it remains unknown."""
        return self._core.lens()

    def overlay_mask(self) -> Image | None:
        """H x W uint8, 0 in regions fixed to the camera; None if nothing was found."""
        return self._core.overlay_mask()

    def stages(self) -> dict[str, tuple[float, int]]:
        """CPU time [s] and calls of each stage so far."""
        return self._core.stages()

    def snapshot(self) -> Map:
        """A copy of the present map; may be called between frames."""
        return Map(self._core.snapshot())

    def finish(self) -> Map:
        """Optimizes the map to convergence and returns it. No frame can be added afterwards."""
        return Map(self._core.finish())
