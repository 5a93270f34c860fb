"""Rendered worlds with exact ground truth: `placegraph synth sequence` from Python.

    dataset = pg.synthetic.render("corridor-loop", "out/corridor", frames=300)
    result = pg.run(dataset)
    print(pg.evaluate(dataset.ground_truth, result.trajectory()))

Equal arguments give equal bits.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping

from . import _core
from ._progress import ProgressArgument, Report, reporting
from ._types import Path, SensorName, sensor_of
from .datasets import Dataset, open_dataset

__all__ = ["World", "defect_set", "render", "worlds"]


def worlds() -> list[str]:
    """Names of the built-in worlds: town-loop, corridor-loop, ..."""
    return list(_core.SyntheticWorld.worlds())


def defect_set(name: str) -> dict[str, float]:
    """The defects of a set, by their names: "none" (all are 0), "hard-drive" or "hard-rgbd".

        defects = pg.synthetic.defect_set("hard-drive") | {"undulation_m": 0}
        world = pg.synthetic.World("town-loop", defects=defects)

    Their meanings are those of the flags of `placegraph synth sequence`, which have the same names.
    """
    return dict(_core.SyntheticWorld.defect_set(name))


class World:
    """A world and a drive through it, whose frames are rendered on demand, without files.

        world = pg.synthetic.World("corridor-loop", frames=100, size=(320, 240))
        slam = pg.Slam(world.calibration(pg.Sensor.RGBD))
        for frame in world.frames(pg.Sensor.RGBD):
            slam.add_frame(frame)

    `world`: a name of `worlds()`, or the path of a KITTI pose file, along which a town is rendered;
    `difficulty`: "clean", "standard" or "hard"; `frames`: at most so many, 0 for all; `duration_s`:
    of the world flight; `size`: width and height of the images [px]; `threads`: of one rendering;
    `defects`: how images and calibration differ from what is written, a name of `defect_set` or
    values by their names, as in {"rolling_shutter_s": 0.015}.
    A sensor of None is what the world usually has: two cameras outdoors, one with depth indoors.
    """

    def __init__(
        self,
        world: str,
        *,
        difficulty: str = "standard",
        seed: int = 1,
        frames: int = 0,
        duration_s: float = 0,
        size: tuple[int, int] | None = None,
        threads: int = 1,
        defects: str | Mapping[str, float] = "none",
    ) -> None:
        values = defect_set(defects) if isinstance(defects, str) else dict(defects)
        self._core = _core.SyntheticWorld(
            world, difficulty=difficulty, seed=seed, frames=frames, duration_s=duration_s,
            size=size, threads=threads, defects=values,
        )

    @property
    def name(self) -> str:
        """The name of the world."""
        return self._core.name

    def __len__(self) -> int:
        return len(self._core)

    def calibration(self, sensor: _core.Sensor | SensorName | None = None) -> _core.Calibration:
        """Calibration of the images of a sensor."""
        return self._core.calibration(sensor_of(sensor))

    @property
    def ground_truth(self) -> _core.Trajectory:
        """Poses of the left camera in the frame of the first one."""
        return self._core.ground_truth

    def frame(self, index: int, sensor: _core.Sensor | SensorName | None = None) -> _core.Frame:
        """Renders a frame with the images that the sensor needs."""
        return self.render(index, sensor).frame

    def frames(self, sensor: _core.Sensor | SensorName | None = None) -> Iterator[_core.Frame]:
        """Renders all frames, one after the other."""
        return (self.frame(index, sensor) for index in range(len(self)))

    def render(
        self,
        index: int,
        sensor: _core.Sensor | SensorName | None = None,
        *,
        labels: bool = False,
        planes: bool = False,
        flow: bool = False,
    ) -> _core.SyntheticFrame:
        """Renders a frame and what is asked for beside it: classes, planes, optical flow."""
        if index < 0:
            raise _core.ArgumentError(f"index: {index} is negative")
        return self._core.render(index, sensor_of(sensor), labels=labels, planes=planes, flow=flow)

    @staticmethod
    def class_names() -> list[str]:
        """Names of the classes, by the values of label images."""
        return _core.SyntheticWorld.class_names()

    def write(
        self,
        folder: Path,
        sensor: _core.Sensor | SensorName | None = None,
        *,
        labels: bool = False,
        flow: bool = False,
        threads: int = 0,
        force: bool = False,
        on_frame: Callable[[int, int], None] | None = None,
        progress: ProgressArgument = None,
    ) -> Dataset:
        """Writes the sequence in KITTI's layout (a flight in EuRoC's), and opens it.

        `labels`: also the class and plane of every pixel; `flow`: also the optical flow; `threads`:
        frames that are rendered at once, 0 for all processors; `force`: replace what the folder
        holds; `on_frame(done, total)` is called after each frame; `progress` counts them (see
        Progress). The folder is written as a whole or not at all, also after Ctrl-C.
        """
        if threads < 0:
            raise _core.ArgumentError(f"threads: {threads} is negative")
        path = os.fspath(folder)
        with reporting(progress, "render", "frames") as report:
            self._core.write(
                path, sensor_of(sensor), labels=labels, flow=flow,
                threads=threads or os.cpu_count() or 1, force=force,
                on_frame=on_frame if report is None else _reported(report, on_frame),
            )
        return open_dataset(path)


def render(
    world: str,
    folder: Path,
    *,
    frames: int = 0,
    sensor: _core.Sensor | SensorName | None = None,
    seed: int = 1,
    difficulty: str = "standard",
    size: tuple[int, int] | None = None,
    duration_s: float = 0,
    defects: str | Mapping[str, float] = "none",
    labels: bool = False,
    flow: bool = False,
    threads: int = 0,
    force: bool = False,
    on_frame: Callable[[int, int], None] | None = None,
    progress: ProgressArgument = None,
) -> Dataset:
    """Renders a sequence into a folder and opens it; see World for the arguments, and World.write.

    The files are those of `placegraph synth sequence`.
    """
    rendered = World(
        world, difficulty=difficulty, seed=seed, frames=frames, duration_s=duration_s, size=size,
        defects=defects,
    )
    return rendered.write(
        folder, sensor, labels=labels, flow=flow, threads=threads, force=force, on_frame=on_frame,
        progress=progress,
    )


def _reported(
    report: Report, on_frame: Callable[[int, int], None] | None
) -> Callable[[int, int], None]:
    """The function that is called after every frame where progress is shown."""

    def after_frame(done: int, total: int) -> None:
        report(done, total, "")
        if on_frame is not None:
            on_frame(done, total)

    return after_frame
