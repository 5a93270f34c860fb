"""Maps as recordings of the viewer rerun."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._optional import optional
from ._types import Path
from .maps import Map, core_of

_BLUE, _GREY, _GREEN, _ORANGE = (40, 110, 220), (150, 150, 150), (40, 160, 80), (230, 130, 30)


def log(map: Map, path: Path, *, component: int | None = None) -> None:
    """Writes a component of a map (None: the main one) as a recording, an .rrd file.

    Entities, in the frame of the component (x right, y down, z forward of its first camera):

        world/trajectory         line along the optimized positions; gaps where frames are lost
        world/trajectory_online  the same as estimated when each frame was processed
        world/camera             pose and view of the camera over the timeline "stamp"
        world/keyframes          pyramids of the keyframes' views
        world/landmarks          points with their colours
        world/places             points, labelled with the ids of the places
        world/loops              lines between the frames of accepted loops
        thumbnail                small images of the keyframes over the timeline, where stored

    The file appears when it is complete. ArgumentError if the map has no such component.
    """
    core = core_of(map)
    sdk = optional("rerun", "rerun")
    path = os.fspath(path)
    if not path.endswith(".rrd"):
        raise _core.ArgumentError(f"path: {path}: a recording ends in .rrd")
    number = core.main_component if component is None else component
    trajectory = map.trajectory(number)
    if trajectory.posed == 0:
        raise _core.ArgumentError("map: no frame has a pose")
    part = f"{path}.part"
    recording = sdk.RecordingStream("placegraph")
    recording.save(part)
    try:
        _log_map(sdk, recording, map, number, trajectory)
        recording.flush()
        recording.disconnect()
        os.replace(part, path)
    finally:
        if os.path.exists(part):
            os.remove(part)


def _log_map(sdk: Any, recording: Any, map: Map, number: int,
             trajectory: _core.Trajectory) -> None:
    recording.log("world", sdk.ViewCoordinates.RDF, static=True)
    _log_line(sdk, recording, "world/trajectory", trajectory, _BLUE)
    if number == map._core.main_component:
        _log_line(sdk, recording, "world/trajectory_online", map.trajectory_online, _GREY)
    _log_camera(sdk, recording, map, trajectory)
    _log_keyframes(sdk, recording, map, number, trajectory.path_length)
    _log_points(sdk, recording, map, number)
    _log_loops(sdk, recording, map, trajectory)


def _strips(trajectory: _core.Trajectory) -> list[NDArray[np.float64]]:
    """The positions, cut where frames have no pose."""
    positions = trajectory.poses[:, :3, 3]
    posed = np.isfinite(positions[:, 0])
    begins = np.flatnonzero(posed & ~np.r_[False, posed[:-1]])
    ends = np.flatnonzero(posed & ~np.r_[posed[1:], False]) + 1
    return [positions[begin:end] for begin, end in zip(begins, ends)]


def _log_line(sdk: Any, recording: Any, entity: str, trajectory: _core.Trajectory,
              colour: tuple[int, int, int]) -> None:
    recording.log(entity, sdk.LineStrips3D(_strips(trajectory), colors=[colour]), static=True)


def _log_camera(sdk: Any, recording: Any, map: Map, trajectory: _core.Trajectory) -> None:
    poses = trajectory.poses
    posed = np.isfinite(poses[:, 0, 3])
    stamps = trajectory.stamps_ns[posed]
    calibration = map.calibration
    if calibration is not None:
        camera = calibration.camera
        recording.log("world/camera", sdk.Pinhole(
            image_from_camera=camera.K(), width=camera.width, height=camera.height,
            camera_xyz=sdk.ViewCoordinates.RDF), static=True)
    recording.send_columns(
        "world/camera",
        indexes=[sdk.TimeColumn("stamp", duration=stamps.astype("timedelta64[ns]"))],
        columns=sdk.Transform3D.columns(translation=poses[posed, :3, 3],
                                        mat3x3=poses[posed, :3, :3]))


def _log_keyframes(sdk: Any, recording: Any, map: Map, number: int, path_length: float) -> None:
    table = map.tables.keyframes
    chosen = np.flatnonzero(table["component"] == number)
    calibration = map.calibration
    if calibration is not None and len(chosen):
        camera = calibration.camera
        depth = 0.01 * path_length or 0.1
        corners = np.array([[u, v] for u, v in ((0, 0), (camera.width - 1, 0), (
            camera.width - 1, camera.height - 1), (0, camera.height - 1))], np.float64)
        rays = np.c_[(corners - [camera.cx, camera.cy]) / [camera.fx, camera.fy], np.ones(4)]
        # The rectangle of the view and its edges to the centre, in one line.
        outline = np.vstack([np.zeros(3), depth * rays])[[0, 1, 2, 0, 3, 4, 0, 1, 4, 3, 2]]
        poses = table["pose"][chosen]
        strips = outline @ poses[:, :3, :3].transpose(0, 2, 1) + poses[:, None, :3, 3]
        recording.log("world/keyframes", sdk.LineStrips3D(strips, colors=[_BLUE]), static=True)
    for row in chosen:
        picture = map.tables.thumbnail(int(table["id"][row]))
        if picture is not None:
            recording.set_time("stamp", duration=np.timedelta64(int(table["stamp_ns"][row]), "ns"))
            recording.log("thumbnail", sdk.EncodedImage(contents=picture, media_type="image/jpeg"))
    recording.reset_time()


def _log_points(sdk: Any, recording: Any, map: Map, number: int) -> None:
    table = map.tables.landmarks
    chosen = table["component"] == number
    recording.log("world/landmarks", sdk.Points3D(table["position"][chosen],
                                                  colors=table["rgb"][chosen]), static=True)
    places = [place for place in map._core.place_rows() if place["component"] == number]
    recording.log("world/places", sdk.Points3D(
        [place["pose"][:3, 3] for place in places], colors=[_ORANGE],
        labels=[str(place["id"]) for place in places], show_labels=False), static=True)


def _log_loops(sdk: Any, recording: Any, map: Map, trajectory: _core.Trajectory) -> None:
    position_of = dict(zip(map.tables.frames["frame"].tolist(), trajectory.poses[:, :3, 3]))
    loops = map.tables.loops
    lines = [
        np.array([position_of[query], position_of[match]])
        for query, match, accepted in zip(loops["query_frame"].tolist(),
                                          loops["match_frame"].tolist(), loops["accepted"])
        if accepted and query in position_of and match in position_of]
    lines = [line for line in lines if np.isfinite(line).all()]
    recording.log("world/loops", sdk.LineStrips3D(lines, colors=[_GREEN]), static=True)
