"""Maps as recordings of rerun, which are read back."""

from __future__ import annotations

import pathlib
from typing import Any

import numpy as np
import pytest

import placegraph as pg

pytest.importorskip("rerun")


@pytest.fixture(scope="module")
def logged(run_folder: pathlib.Path,
           tmp_path_factory: pytest.TempPathFactory) -> tuple[pg.Map, dict[str, list[Any]]]:
    """A map, and the tables of its recording by the paths of entities."""
    from placegraph import rerun

    chunk = pytest.importorskip("rerun.chunk")
    opened = pg.Map.open(run_folder)
    path = tmp_path_factory.mktemp("rerun") / "map.rrd"
    rerun.log(opened, path)
    assert not path.with_name("map.rrd.part").exists()
    tables: dict[str, list[Any]] = {}
    for each in chunk.RrdReader(str(path)).stream():
        tables.setdefault(str(each.entity_path), []).append(each.to_record_batch())
    return opened, tables


def values(tables: dict[str, list[Any]], entity: str, name: str) -> list[Any]:
    """The rows of the column whose name ends so."""
    rows: list[Any] = []
    for batch in tables[entity]:
        for column in batch.schema.names:
            if column.endswith(name):
                rows += [row for row in batch.column(column).to_pylist() if row is not None]
    return rows


def test_entities(logged: tuple[pg.Map, dict[str, list[Any]]]) -> None:
    paths = {path for path in logged[1] if not path.startswith("/__")}
    assert {"/world", "/world/trajectory", "/world/trajectory_online", "/world/camera",
            "/world/keyframes", "/world/landmarks", "/world/places", "/world/loops",
            "/thumbnail"} <= paths


def test_landmarks(logged: tuple[pg.Map, dict[str, list[Any]]]) -> None:
    opened, tables = logged
    (points,) = values(tables, "/world/landmarks", "positions")
    np.testing.assert_allclose(points, opened.landmarks, rtol=1e-6, atol=1e-6)
    (colours,) = values(tables, "/world/landmarks", "colors")
    rgb = opened.tables.landmarks["rgb"][0].astype(int)
    assert colours[0] >> 8 == (rgb[0] << 16) + (rgb[1] << 8) + rgb[2]


def test_trajectory_and_camera(logged: tuple[pg.Map, dict[str, list[Any]]]) -> None:
    opened, tables = logged
    poses = opened.trajectory().poses
    (strips,) = values(tables, "/world/trajectory", "strips")
    np.testing.assert_allclose(np.vstack(strips), poses[:, :3, 3], atol=1e-6)
    translations = np.vstack(values(tables, "/world/camera", "translation"))
    np.testing.assert_allclose(translations, poses[:, :3, 3], atol=1e-6)


def test_keyframes_and_places(logged: tuple[pg.Map, dict[str, list[Any]]]) -> None:
    opened, tables = logged
    keyframes = opened.tables.keyframes
    (strips,) = values(tables, "/world/keyframes", "strips")
    assert len(strips) == len(keyframes["id"])
    # A pyramid begins at the centre of its camera, and the middle of its view lies ahead.
    np.testing.assert_allclose([strip[0] for strip in strips], keyframes["pose"][:, :3, 3],
                               atol=1e-6)
    corners = np.array(strips[0])[[1, 2, 4, 5]] - strips[0][0]
    assert (corners @ keyframes["pose"][0][:3, 2] > 0).all()
    (labels,) = values(tables, "/world/places", ":labels")
    assert labels == [str(node) for node in opened.places.nodes]
    assert len(values(tables, "/thumbnail", "blob")) == len(keyframes["id"])
