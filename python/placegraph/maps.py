"""Maps: what a SLAM run leaves, and the localization of images in them."""

from __future__ import annotations

import itertools
import os
import re
import warnings
from collections.abc import Iterable, Sequence, Sized
from typing import TYPE_CHECKING, Any

from . import _core
from ._notebook import figure_html
from ._optional import optional
from ._progress import ProgressArgument, Report, reporting
from ._tables import table_of
from ._types import Path
from ._words import arguments_named
from .options import LocalizerOptions, RunOptions, given_or_default

if TYPE_CHECKING:
    import networkx
    import numpy as np
    import pandas
    from numpy.typing import NDArray
    from typing_extensions import Self

    Image = NDArray[np.uint8] | _core.Frame

Explanation = _core.Explanation
Judgement = _core.Judgement
Localization = _core.Localization
LoopRecord = _core.LoopRecord

_AT_ONCE = 32  # images, so that a long stream needs little memory


class MapFile:
    """A map as a file: where it is from, what made it, and what can be written of it."""

    def __init__(self, core: _core.Map, path: str = "") -> None:
        self._core = core
        self._path = path

    @classmethod
    def open(cls, path: Path) -> Self:
        """Reads a saved map, and checks everything in it.

        `path`: map.db, or the folder of `placegraph run` that has it. FileError (an OSError) names
        the file, the table and the row of what is damaged.
        """
        path = os.fspath(path)
        core = _core.Map.open(path)
        return cls(core, os.path.join(path, "map.db") if os.path.isdir(path) else path)

    def save(self, path: Path) -> None:
        """Writes the map as one file, as a whole or not at all."""
        self._core.save(os.fspath(path))

    def export(
        self,
        *,
        component: int | None = None,
        ascii: bool = False,
        resolution_m: float = 0.05,
        walls: bool = False,
        voxel: float | None = None,
        force: bool = False,
        **paths: Path,
    ) -> str:
        """Writes parts of the map as files, as `placegraph map export` does.

            m.export(ply="landmarks.ply", tum="trajectory.tum", colmap="model")

        `export_forms` names the forms. `component`: its number, None: the main one; `ascii`:
        numbers as text where a form has both; `resolution_m`: side of a cell of an occupancy grid,
        `walls`: with the walls of the floor plan; `voxel`: side of the voxels of cloud and mesh;
        `force`: existing files are replaced. Returns a summary of models, clouds and meshes.
        """
        known = [name for name, _ in _core.Map.export_forms()]
        for name in paths:
            if name not in known:
                raise _core.ArgumentError(f"{name}: no such form; there are {', '.join(known)}")
        with arguments_named({"see --help for the forms": "see Map.export_forms()"}):
            return self._core.export_files(
                {name: os.fspath(path) for name, path in paths.items()},
                component, ascii, resolution_m, walls, voxel, force)

    @staticmethod
    def export_forms() -> dict[str, str]:
        """The forms that `export` writes, each with what it is."""
        return dict(_core.Map.export_forms())

    @property
    def path(self) -> str:
        """The file that the map was read from; empty for a map of this process."""
        return self._path

    @property
    def metric(self) -> bool:
        """Whether lengths are in metres."""
        return self._core.metric

    @property
    def judgement(self) -> Judgement | None:
        """What the run says of itself: verdict, findings, expected drift; None if unknown."""
        return self._core.judgement

    @property
    def calibration(self) -> _core.Calibration | None:
        """Calibration of the images as they were used; None for a map of images alone."""
        return self._core.calibration

    @property
    def sequence(self) -> str:
        """Path of the recording; may be assigned where the recording has moved."""
        return self._core.sequence

    @sequence.setter
    def sequence(self, path: Path) -> None:
        self._core.sequence = os.fspath(path)

    @property
    def options(self) -> RunOptions:
        """A copy of the options of the run."""
        return RunOptions.from_yaml(self._core.options_yaml, self._path or "map")


class Map(MapFile):
    """The result of a SLAM run: trajectory, keyframes, landmarks, places, loops, judgement.

    Poses T_map_cam and positions are in the frame of their component; lengths are in metres if
    `metric`, else in an arbitrary unit.
    """

    def __init__(self, core: _core.Map, path: str = "") -> None:
        super().__init__(core, path)
        self._localizer: Localizer | None = None

    def trajectory(self, component: int | None = None) -> _core.Trajectory:
        """The optimized pose T_map_cam of every frame of a component; None: of the main one."""
        return self._core.trajectory(component)

    @property
    def trajectory_online(self) -> _core.Trajectory:
        """Every pose of the main component as it was estimated when its frame was processed."""
        return self._core.trajectory_online

    @property
    def pose_graph(self) -> _core.PoseGraph:
        """The places and the constraints between them as a pose graph."""
        return self._core.pose_graph()

    @property
    def tables(self) -> Tables:
        """Frames, keyframes, landmarks, observations, loops as dictionaries of arrays."""
        return Tables(self._core)

    @property
    def landmarks(self) -> NDArray[np.float64]:
        """Positions of the landmarks of the main component in the map, N x 3."""
        table = self._core.landmark_table()
        positions: NDArray[np.float64] = table["position"]
        main: NDArray[np.float64] = positions[table["component"] == self._core.main_component]
        main.setflags(write=False)
        return main

    @property
    def frames(self) -> pandas.DataFrame:
        """The frames: frame, stamp_ns, keyframe (-1: lost), inliers, confidence, reason."""
        return table_of(self._core.frame_table())

    @property
    def keyframes(self) -> pandas.DataFrame:
        """The keyframes, without their poses (`tables.keyframes`)."""
        return table_of(self._core.keyframe_table())

    @property
    def observations(self) -> pandas.DataFrame:
        """The observations of landmarks: keyframe, landmark, px_x, px_y, camera."""
        return table_of(self._core.observation_table())

    @property
    def loops(self) -> pandas.DataFrame:
        """Every loop candidate: frames, the stage that decided, evidence."""
        return table_of(self._core.loop_table())

    @property
    def components(self) -> pandas.DataFrame:
        """The components: number, main, posed, first_frame, last_frame."""
        columns = ["number", "main", "posed", "first_frame", "last_frame"]
        pandas = optional("pandas", "pandas")
        return pandas.DataFrame(  # type: ignore[no-any-return]
            self._core.component_rows(), columns=columns)

    @property
    def places(self) -> networkx.Graph:
        """The places as a networkx graph; an edge for each pair that a constraint joins.

        Nodes: anchor_keyframe, component, labels, environment ("street", "corridor", ... or None),
        pose (T_map_place, 4 x 4), scale, keyframes; edges: sources, a set of names.
        """
        graph: networkx.Graph = optional("networkx", "networkx").Graph()
        for place in self._core.place_rows():
            graph.add_node(place.pop("id"), **place)
        for edge in self._core.edge_rows():
            if graph.has_edge(edge["from"], edge["to"]):
                graph.edges[edge["from"], edge["to"]]["sources"].add(edge["source"])
            else:
                graph.add_edge(edge["from"], edge["to"], sources={edge["source"]})
        return graph

    def explain(self, frame: int) -> Explanation:
        """Why a frame has its pose, or none: place, evidence, loops accepted and refused."""
        return self._core.explain(frame)

    def localize(self, image: Image) -> Localization:
        """Localizes one image in the map: its pose, or why there is none.

        `image`: H x W uint8, H x W x 3 uint8 (BGR) or a frame, of the map's camera. The first call
        prepares a `Localizer`, which further calls use.
        """
        if self._localizer is None:
            self._localizer = Localizer(self)
        return self._localizer.localize(image)

    def _repr_html_(self) -> str:
        trajectory = self.trajectory()
        unit = "m" if self.metric else "units"
        accepted = sum(self.tables.loops["accepted"])
        rows = [
            ("frames", f"{len(trajectory)}, {trajectory.posed} with a pose"),
            ("path", f"{trajectory.path_length:.4g} {unit}"),
            ("keyframes", str(len(self.tables.keyframes["id"]))),
            ("places", str(len(self._core.place_rows()))),
            ("landmarks", str(len(self.tables.landmarks["id"]))),
            ("loops", f"{accepted} accepted of {len(self.tables.loops['accepted'])}"),
        ]
        if self.judgement is not None:
            rows.append(("judgement", self.judgement.verdict))
            rows += [("", str(finding)) for finding in self.judgement.findings]
        return figure_html(rows, self._picture() if trajectory.posed else "")

    def _picture(self) -> str:
        """Trajectories, places and loops, SVG; over the true trajectory if it is known."""
        return _core.map_picture(self._core, self._truth(), os.path.basename(self.sequence))

    def _truth(self) -> _core.Trajectory | None:
        """The ground truth of the recording, if it is there and has a pose for each frame."""
        if not os.path.isdir(self.sequence):
            return None
        try:
            truth = _core.open_dataset(self.sequence).ground_truth
        except _core.Error:
            return None
        frames = self.tables.frames["frame"]
        return truth if truth is not None and len(frames) and frames.max() < len(truth) else None

    def __repr__(self) -> str:
        trajectory = self.trajectory()
        unit = "m" if self.metric else "units"
        verdict = self.judgement.verdict if self.judgement else "not judged"
        return (f"<placegraph.Map: {trajectory.posed} of {self._core.frame_count} frames posed, "
                f"path {trajectory.path_length:.4g} {unit}, {verdict}>")


class Tables:
    """Parts of a map as dictionaries of arrays, one entry for each row."""

    def __init__(self, core: _core.Map) -> None:
        self._core = core

    @property
    def frames(self) -> dict[str, Any]:
        """frame, stamp_ns, keyframe (-1: no pose), inliers, confidence, reason."""
        return self._core.frame_table()

    @property
    def keyframes(self) -> dict[str, Any]:
        """id, frame, stamp_ns, place, component, pose (T_map_cam, N x 4 x 4)."""
        return self._core.keyframe_table()

    @property
    def landmarks(self) -> dict[str, Any]:
        """id, keyframe, component, position (N x 3), covariance (N x 3 x 3), rgb (N x 3 uint8).

        Covariances are in the map frame, given the poses of the keyframes; NaN if unknown.
        """
        return self._core.landmark_table()

    @property
    def observations(self) -> dict[str, Any]:
        """keyframe, landmark, px (N x 2 float32), camera."""
        return self._core.observation_table()

    @property
    def loops(self) -> dict[str, Any]:
        """query_frame, match_frame, accepted, stage, model, inliers, lines, similarity, ..."""
        return self._core.loop_table()

    def features(self, keyframe: int) -> dict[str, Any]:
        """Features of a keyframe: px, angle_rad, octave, descriptor (N x 32), point_cam."""
        return self._core.feature_table(keyframe)

    def thumbnail(self, keyframe: int) -> bytes | None:
        """The image of a keyframe as a small JPEG file; None if it is not stored."""
        return self._core.thumbnail(keyframe)


def core_of(map: Map) -> _core.Map:
    """The map of C++; ArgumentError if the argument `map` is something else."""
    if not isinstance(map, Map):
        raise _core.ArgumentError(f"map: a Map is needed, not {type(map).__name__}")
    return map._core


def localizer_options(map: Map) -> LocalizerOptions:
    """Options for `Localizer`: cues as in the views of the map, loops as in its run.

    NoResult if the map has no views of its keyframes.
    """
    return LocalizerOptions.from_yaml(_core.localizer_options(core_of(map)).to_yaml())


class Localizer:
    """Localizes images in a map, with a calibrated probability.

        localizer = pg.Localizer(pg.Map.open("out/map.db"))
        for image in images:
            at = localizer.localize(image)
            print(at.T_map_cam if at.T_map_cam else at.without_pose or at.stage)
    """

    def __init__(self, map: Map, options: LocalizerOptions | None = None) -> None:
        """Copies the map and prepares its keyframes; at least ten need a stored appearance."""
        core = core_of(map)
        if options is None:
            options = localizer_options(map)
        options = given_or_default(options, LocalizerOptions)
        self._core = _core.MapLocalizer(core, options._set)

    def localize(self, image: Image) -> Localization:
        """Localizes one image: H x W uint8, H x W x 3 uint8 (BGR), or a frame."""
        try:
            at = self._core.localize([image], False)[0]
        except _core.ArgumentError as error:
            raise _core.ArgumentError(str(error).replace("images[0]", "image")) from None
        _warn_of_refusals([at])
        return at

    def localize_all(
        self,
        images: Iterable[Image],
        *,
        sequence: bool = False,
        progress: ProgressArgument = None,
    ) -> list[Localization]:
        """Localizes images, one result each.

        The images of an iterator are taken as they are needed, some tens at once. `sequence`: they
        are consecutive images of one drive, and neighbours are evidence; all are taken at once.
        `progress` counts images (see Progress).
        """
        remaining = iter(images)
        total = len(images) if isinstance(images, Sized) else None
        results: list[Localization] = []
        with reporting(progress, "localize", "images") as report:
            while part := list(itertools.islice(remaining, None if sequence else _AT_ONCE)):
                results += self._localized(part, sequence, len(results), total, report)
            if report is not None:
                report(len(results), total, "")
        _warn_of_refusals(results)
        return results

    def _localized(self, part: list[Image], sequence: bool, first: int, total: int | None,
                   report: Report | None) -> list[Localization]:
        """The results of some images; `first`: number of the first of them."""
        on_image = None if report is None else lambda i: report(first + i, total, "")
        try:
            return self._core.localize(part, sequence, on_image)
        except _core.ArgumentError as error:
            raise _core.ArgumentError(re.sub(
                r"^images\[(\d+)\]", lambda at: f"images[{first + int(at[1])}]", str(error)
            )) from None


def _warn_of_refusals(results: Sequence[Localization]) -> None:
    """Warns of images that could not be compared, at the line of the user's."""
    refused = [i for i, at in enumerate(results) if at.stage == "grey"]
    if refused:
        warnings.warn(f"{len(refused)} of {len(results)} images are refused before the comparison, "
                      f"the first is number {refused[0]}: they are grey, and the map's images have "
                      "colour", _core.Doubt, stacklevel=3)
