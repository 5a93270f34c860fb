"""Pictures and pages of maps, evaluations and pose graphs: in notebooks, and as files."""

from __future__ import annotations

import html
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Union

from . import _core
from ._types import Path

if TYPE_CHECKING:
    from .evaluation import Evaluation
    from .maps import Map

    from .graphs import OptimizedGraph

    Shown = Union[Map, Evaluation, Sequence[Evaluation], _core.PoseGraph, OptimizedGraph]


def _truth_of(shown: Map) -> _core.Trajectory | None:
    """The ground truth of a map's recording, if it is still there and has a pose for each frame."""
    if not os.path.isdir(shown.sequence):
        return None
    try:
        truth = _core.open_dataset(shown.sequence).ground_truth
    except _core.Error:
        return None
    frames = shown.tables.frames["frame"]
    return truth if truth is not None and len(frames) and frames.max() < len(truth) else None


def _table(rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
                    for name, value in rows)
    return f"<table>{cells}</table>"


def _figure(rows: Sequence[tuple[str, str]], svg: str) -> str:
    fitted = svg.replace("<svg ", "<svg style='max-width:100%;height:auto' ", 1)
    return f"<div>{_table(rows)}{fitted}</div>"


def map_picture(shown: Map) -> str:
    """Trajectories, places and loops of a map, SVG; over the true trajectory if it is known."""
    return _core.map_picture(shown._core, _truth_of(shown), os.path.basename(shown.sequence))


def map_html(shown: Map) -> str:
    """What a notebook shows of a map: its figures and its picture."""
    trajectory = shown.trajectory()
    unit = "m" if shown.metric else "units"
    accepted = sum(shown.tables.loops["accepted"])
    rows = [
        ("frames", f"{len(trajectory)}, {trajectory.posed} with a pose"),
        ("path", f"{trajectory.path_length:.4g} {unit}"),
        ("keyframes", str(len(shown.tables.keyframes["id"]))),
        ("places", str(len(shown._core.place_rows()))),
        ("landmarks", str(len(shown.tables.landmarks["id"]))),
        ("loops", f"{accepted} accepted of {len(shown.tables.loops['accepted'])}"),
    ]
    if shown.judgement is not None:
        rows.append(("judgement", shown.judgement.verdict))
        rows += [("", str(finding)) for finding in shown.judgement.findings]
    return _figure(rows, map_picture(shown) if trajectory.posed else "")


def evaluation_html(shown: Evaluation, kind: str = "overview") -> str:
    """What a notebook shows of an evaluation: its figures and the picture of a kind."""
    core = shown._core
    if not core.ok:
        return _table([(core.name, core.reason)])
    rows = [(row["name"], f"{row['value']:.6g} {row['unit']}") for row in core.metric_rows()
            if row["value"] is not None]
    return _figure(rows, _core.evaluation_picture([core], kind))


def pose_graph_html(graph: _core.PoseGraph) -> str:
    """What a notebook shows of a pose graph: its size and its picture."""
    rows = [("nodes", str(len(graph))), ("edges", str(len(graph.edges)))]
    return _figure(rows, _core.pose_graph_picture(graph) if len(graph) else "")


def optimized_html(report: OptimizedGraph) -> str:
    """What a notebook shows of an optimized pose graph: its costs and its picture."""
    rejected = [edge.constraint for edge in report.rejected]
    rows = [("nodes", str(len(report.graph))),
            ("cost", f"{report.chi2_initial:.6g} -> {report.chi2_final:.6g}"),
            ("iterations", str(report.iterations)),
            ("rejected constraints", str(len(rejected)))]
    if not report.ok:
        rows.append(("no minimum", report.reason))
    svg = _core.pose_graph_picture(report.graph, None, rejected) if len(report.graph) else ""
    return _figure(rows, svg)


def page_of(shown: Shown, *, title: str = "", truth: str = "ground truth") -> str:
    """The page of a map, of evaluations or of a pose graph: one HTML file without a network.

    It is that of `placegraph report`, `placegraph eval --report` and `placegraph graph optimize
    --report`. `title`: empty for the name of the map; `truth`: name of the truth of evaluations.
    """
    from .evaluation import Comparison, Evaluation
    from .graphs import OptimizedGraph
    from .maps import Map

    if isinstance(shown, Map):
        return _core.map_page(shown._core, shown.path, title)
    if isinstance(shown, _core.PoseGraph):
        return _core.pose_graph_page(shown, shown, title=title or "pose graph")
    if isinstance(shown, OptimizedGraph):
        rejected = [edge.constraint for edge in shown.rejected]
        return _core.pose_graph_page(shown.graph, shown.graph, list(shown.chi2_by_constraint),
                                     rejected, title or "pose graph")
    results = [shown] if isinstance(shown, Evaluation) else shown
    if not isinstance(results, Sequence) or not results or not all(
            isinstance(result, Evaluation) for result in results):
        raise _core.ArgumentError(
            "shown: a Map, Evaluations, a PoseGraph or its report is needed, "
            f"not {type(shown).__name__}")
    sequences = isinstance(shown, Comparison) and shown.own_truths
    return _core.evaluation_page([result._core for result in results], truth, sequences)


class Page:
    """A page that a notebook shows in a frame.

    The frame is no sandbox: the page's own policy lets it load nothing from elsewhere, and names in
    its data are text.
    """

    def __init__(self, text: str, height: int) -> None:
        if not isinstance(height, int) or height <= 0:
            raise _core.ArgumentError(f"height: {height!r} is no number of pixels")
        self.text = text
        self.height = height

    def _repr_html_(self) -> str:
        text, height = (html.escape(str(each), quote=True) for each in (self.text, self.height))
        return (f"<iframe srcdoc=\"{text}\" width=\"100%\" height=\"{height}\" "
                "style=\"border:0\"></iframe>")


def _in_notebook() -> bool:
    """Whether this process is the kernel of a notebook."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


def show(
    shown: Shown,
    path: Path | None = None,
    *,
    title: str = "",
    truth: str = "ground truth",
    height: int = 700,
    browser: bool = False,
) -> Page | str:
    """Shows a map, evaluations or a pose graph as `page_of` makes the page.

    In a notebook without `path`: a frame in the output of the cell, `height` pixels high. Otherwise
    the page is written to `path` (None: a file in the folder for temporary files), which is
    returned; `browser` opens it there.
    """
    text = page_of(shown, title=title, truth=truth)
    if path is None and _in_notebook():
        return Page(text, height)
    if path is None:
        import tempfile

        handle, path = tempfile.mkstemp(prefix="placegraph-", suffix=".html")
        os.close(handle)
    path = os.fspath(path)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    if browser:
        import webbrowser

        webbrowser.open("file://" + os.path.abspath(path))
    return path
