"""Wrong use of maps, pictures and recordings: an exception that names the argument."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from placegraph import _core
from placegraph._show import Page, page_of

Use = Callable[[pg.Map, pathlib.Path], Any]


def rerun_log(opened: pg.Map, path: pathlib.Path) -> None:
    pytest.importorskip("rerun")
    from placegraph import rerun

    rerun.log(opened, path)


CASES: list[tuple[str, Use, type[Exception], str]] = [
    ("no such file", lambda m, p: pg.Map.open(p / "none.db"), OSError, "none.db"),
    ("no map", lambda m, p: pg.Map.open(_text(p / "text.db")), OSError, "text.db"),
    ("cut map", lambda m, p: pg.Map.open(_cut(m, p / "cut.db")), OSError, "cut.db"),
    ("a folder without a map", lambda m, p: pg.Map.open(p), OSError, "map.db"),
    ("path of a number", lambda m, p: pg.Map.open(3), TypeError, "int"),  # type: ignore[arg-type]
    ("save into no folder", lambda m, p: m.save(p / "none" / "m.db"), OSError, "none"),
    ("component", lambda m, p: m.trajectory(77), ValueError, "component"),
    ("component of text", lambda m, p: m.trajectory("a"), TypeError, "component"),  # type: ignore[arg-type]
    ("frame", lambda m, p: m.explain(10**6), ValueError, "frame"),
    ("frame below 0", lambda m, p: m.explain(-1), ValueError, "frame"),
    ("frame of text", lambda m, p: m.explain("a"), TypeError, "frame"),  # type: ignore[arg-type]
    ("keyframe", lambda m, p: m.tables.features(10**6), ValueError, "keyframe"),
    ("thumbnail", lambda m, p: m.tables.thumbnail(-1), ValueError, "keyframe"),
    ("no form", lambda m, p: m.export(), ValueError, "nothing to write"),
    ("unknown form", lambda m, p: m.export(obj=p / "a.obj"), ValueError, "obj"),
    ("form of a component", lambda m, p: m.export(ply=p / "a.ply", component=9), ValueError,
     "component"),
    ("existing file", lambda m, p: m.export(ply=_text(p / "a.ply")), ValueError, "a.ply"),
    ("existing file, by its argument", lambda m, p: m.export(ply=_text(p / "a.ply")), ValueError,
     "force=True overwrites"),
    ("component, by its argument", lambda m, p: m.export(ply=p / "a.ply", component=9), ValueError,
     "component: map has no component 9"),
    ("no form, by the function", lambda m, p: m.export(), ValueError, "Map.export_forms()"),
    ("voxel, by its argument", lambda m, p: m.export(cloud=p / "a.ply", voxel=-1), ValueError,
     "voxel: must be positive"),
    ("extension", lambda m, p: m.export(gltf=p / "a.txt"), ValueError, "gltf: "),
    ("cells", lambda m, p: m.export(occupancy=p / "a", resolution_m=-1), ValueError,
     "resolution_m"),
    ("cells that are not finite", lambda m, p: m.export(occupancy=p / "a", resolution_m=np.nan),
     ValueError, "resolution_m"),
    ("voxel", lambda m, p: m.export(cloud=p / "a.ply", voxel=-1), ValueError, "voxel"),
    ("image of text", lambda m, p: pg.Localizer(m).localize("image"), ValueError, "image: "),  # type: ignore[arg-type]
    ("image of floats", lambda m, p: pg.Localizer(m).localize(np.zeros((9, 9))), ValueError,  # type: ignore[arg-type]
     "image: "),
    ("image of four channels", lambda m, p: pg.Localizer(m).localize(
        np.zeros((9, 9, 4), np.uint8)), ValueError, "image: "),
    ("second image", lambda m, p: pg.Localizer(m).localize_all(
        [np.zeros((9, 9), np.uint8), np.zeros((0, 9), np.uint8)]), ValueError, "images[1]"),
    ("image far along a stream", lambda m, p: pg.Localizer(m).localize_all(
        np.zeros((9, 9 if i < 40 else 0), np.uint8) for i in range(50)), ValueError, "images[40]"),
    ("image that is None", lambda m, p: m.localize(None), ValueError, "image: "),  # type: ignore[arg-type]
    ("no map to localize in", lambda m, p: pg.Localizer(None), ValueError, "map"),  # type: ignore[arg-type]
    ("no map for options", lambda m, p: pg.localizer_options(3), ValueError, "map"),  # type: ignore[arg-type]
    ("no map for COLMAP", lambda m, p: pg.colmap.to_pycolmap(3), ValueError, "map"),  # type: ignore[arg-type]
    ("no map for rerun", lambda m, p: pg.rerun.log(3, p / "a.rrd"), ValueError, "map"),  # type: ignore[arg-type]
    ("options of no kind", lambda m, p: pg.Localizer(m, {}), ValueError, "options"),  # type: ignore[arg-type]
    ("height of a page", lambda m, p: Page("", '7" onload="x'), ValueError, "height"),  # type: ignore[arg-type]
    ("height of nothing", lambda m, p: Page("", 0), ValueError, "height"),
    ("options of another kind", lambda m, p: pg.Localizer(m, pg.RunOptions()), ValueError,  # type: ignore[arg-type]
     "options"),
    ("truth of other frames", lambda m, p: _core.map_picture(m._core, pg.Trajectory()), ValueError,
     "truth"),
    ("what is shown", lambda m, p: page_of(3), ValueError, "shown"),  # type: ignore[arg-type]
    ("nothing is shown", lambda m, p: page_of([]), ValueError, "shown"),
    ("kind of a picture", lambda m, p: _core.evaluation_figure([], "overview"), ValueError,
     "results"),
    ("page into no folder", lambda m, p: pg.show(m, p / "none" / "a.html"), OSError, "none"),
    ("other graph", lambda m, p: _core.pose_graph_picture(m.pose_graph, pg.PoseGraph()),
     ValueError, "before"),
    ("empty graph", lambda m, p: page_of(pg.PoseGraph()), ValueError, "graph"),
    ("rejected", lambda m, p: _core.pose_graph_page(m.pose_graph, m.pose_graph, rejected=[99999]),
     ValueError, "rejected"),
    ("recording of another suffix", lambda m, p: rerun_log(m, p / "a.txt"), ValueError, ".rrd"),
    ("pattern", lambda m, p: _core.demosaic(np.zeros((8, 8), np.uint8), "rgb"), ValueError,
     "pattern"),
    ("pixels", lambda m, p: _core.write_image(str(p / "a.png"), np.zeros((4, 4, 2), np.uint8)),
     ValueError, "image"),
    ("gap", lambda m, p: m.trajectory().resample([1], -1), ValueError, "max_gap_s"),
    ("imu", lambda m, p: _core.write_imu(str(p / "imu"), [1, 2], np.zeros((2, 3)), np.zeros((1, 3)),
                                         1, [1, 1, 1, 1]), ValueError, "accel_m_s2"),
    ("imu times", lambda m, p: _core.write_imu(str(p / "imu"), [2, 2], np.zeros((2, 3)),
                                               np.zeros((2, 3)), 1, [1, 1, 1, 1]), ValueError,
     "stamps_ns"),
]


def _text(path: pathlib.Path) -> pathlib.Path:
    path.write_text("no map")
    return path


def _cut(opened: pg.Map, path: pathlib.Path) -> pathlib.Path:
    content = pathlib.Path(opened.path).read_bytes()
    path.write_bytes(content[:len(content) // 2])
    return path


@pytest.fixture(scope="module")
def opened(run_folder: pathlib.Path) -> pg.Map:
    return pg.Map.open(run_folder)


@pytest.mark.parametrize("use, expected, text", [case[1:] for case in CASES],
                         ids=[case[0] for case in CASES])
def test_wrong_use(opened: pg.Map, tmp_path: pathlib.Path, use: Use, expected: type[Exception],
                   text: str) -> None:
    with pytest.raises(expected) as raised:
        use(opened, tmp_path)
    assert text in str(raised.value)
