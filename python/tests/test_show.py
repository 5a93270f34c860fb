"""Pages and pictures: those of the program, in notebooks and as files."""

from __future__ import annotations

import json
import pathlib
import re
import subprocess
import sys
import types
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np
import pytest

import placegraph as pg
from placegraph._show import Page, page_of


def data_of(page: str) -> dict[str, Any]:
    """What a page shows."""
    found = re.search(r'<script id="placegraph-report" type="application/json">(.*?)</script>',
                      page, re.DOTALL)
    assert found is not None
    return json.loads(found.group(1))  # type: ignore[no-any-return]


def lines_of(html: str) -> int:
    """Number of drawn lines in the picture of a text of HTML, which must be well formed."""
    svg = html[html.index("<svg"):html.index("</svg>") + 6]
    return sum(element.tag.endswith(("polyline", "path", "line"))
               for element in ET.fromstring(svg).iter())


def small_graph() -> pg.PoseGraph:
    ids = np.arange(4)
    poses = np.zeros((4, 7))
    poses[:, 0] = ids
    poses[:, 6] = 1
    edges = np.array([[0, 1], [1, 2], [2, 3]])
    step = np.tile([1.0, 0, 0, 0, 0, 0, 1], (3, 1))
    return pg.PoseGraph.from_arrays(ids, poses, edges, step, np.tile(np.eye(6), (3, 1, 1)))


@pytest.fixture(scope="module")
def opened(run_folder: pathlib.Path) -> pg.Map:
    return pg.Map.open(run_folder)


def test_page_of_a_map_is_that_of_the_program(opened: pg.Map, run_folder: pathlib.Path,
                                              program: str, tmp_path: pathlib.Path) -> None:
    written = tmp_path / "program.html"
    subprocess.run([program, "report", str(run_folder), "--out", str(written)], check=True,
                   capture_output=True)
    path = pg.show(opened, tmp_path / "page.html")
    assert isinstance(path, str)
    ours, theirs = (data_of(pathlib.Path(name).read_text()) for name in (path, written))
    for data in (ours, theirs):
        data.pop("generated", None)
    assert ours["runs"] == theirs["runs"]
    assert ours["runs"][0]["figures"], "the errors against the ground truth"


def test_map_in_a_notebook(opened: pg.Map) -> None:
    html = opened._repr_html_()
    assert lines_of(html) > 4
    assert f"{len(opened.tables.keyframes['id'])}" in html
    assert "optimized" in html and "good" in html


def test_map_without_its_recording(opened: pg.Map) -> None:
    moved = pg.Map.open(opened.path)
    moved.sequence = "/nowhere"
    assert lines_of(moved._repr_html_()) > 2
    assert "no ground truth" in moved._repr_html_()
    assert not data_of(page_of(moved))["runs"][0]["figures"]


def test_evaluation(drive: pathlib.Path, opened: pg.Map) -> None:
    truth = pg.open_dataset(str(drive)).ground_truth
    assert truth is not None
    result = pg.evaluate(truth, opened.trajectory(), name="mine")
    html = result._repr_html_()
    assert lines_of(html) > 4
    row = next(row for row in result._core.metric_rows() if row["value"] is not None)
    assert row["name"] in html and f"{row['value']:.6g}" in html
    page = data_of(page_of([result, result], truth="rendered"))
    assert len(page["runs"]) == 2


def test_page_of_sequences(tmp_path: pathlib.Path) -> None:
    stamps, still = np.arange(40) * 10**8, np.tile(np.eye(4), (40, 1, 1))
    folders = [tmp_path / "truth", tmp_path / "estimates"]
    for folder in folders:
        folder.mkdir()
        for name, speed in (("a", 1.0), ("b", 2.0)):
            poses = still.copy()
            poses[:, 0, 3] = speed * np.arange(40) + (folder is folders[1]) * np.sin(np.arange(40))
            pg.Trajectory.from_arrays(stamps, poses).write(str(folder / f"{name}.tum"),
                                                           pg.TrajectoryFormat.TUM)
    both = pg.compare(*folders)
    page = data_of(pg.page_of(both))
    assert both.own_truths and page != data_of(pg.page_of(list(both)))


def test_pose_graph() -> None:
    graph = small_graph()
    assert lines_of(graph._repr_html_()) >= 3  # type: ignore[attr-defined]
    report = pg.optimize(graph)
    assert "iterations" in report._repr_html_()  # type: ignore[attr-defined]
    empty = pg.optimize(pg.PoseGraph())
    assert "<th style='text-align:left'>nodes</th><td style='text-align:left'>0</td>" in (
        empty._repr_html_())  # type: ignore[attr-defined]
    for shown in (graph, report):
        assert len(data_of(page_of(shown))["graphs"]) == 1


def test_show_without_a_path_writes_a_file(opened: pg.Map) -> None:
    path = pg.show(opened)
    assert isinstance(path, str)
    written = pathlib.Path(path)
    assert written.suffix == ".html" and "<html" in written.read_text()
    written.unlink()


def test_show_in_a_notebook(opened: pg.Map, monkeypatch: pytest.MonkeyPatch) -> None:
    shell = types.SimpleNamespace(kernel=object())
    module = types.SimpleNamespace(get_ipython=lambda: shell)
    monkeypatch.setitem(sys.modules, "IPython", module)
    page = pg.show(opened, title='a "run"')
    assert isinstance(page, Page)
    html = page._repr_html_()
    srcdoc = re.search(r'srcdoc="([^"]*)"', html)
    assert srcdoc is not None
    import html as escapes

    assert escapes.unescape(srcdoc.group(1)) == page.text
    assert data_of(page.text)["title"] == 'a "run"'
    assert 'height="700"' in html
