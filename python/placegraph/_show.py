"""Pages of maps, evaluations and pose graphs: in notebooks, and as files."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Union

from . import _core
from ._notebook import escaped
from ._types import Path
from .comparison import Comparison
from .evaluation import Evaluation
from .graphs import OptimizedGraph
from .maps import Map

Shown = Union[Map, Evaluation, Sequence[Evaluation], _core.PoseGraph, OptimizedGraph]


def page_of(shown: Shown, *, title: str = "", truth: str = "ground truth") -> str:
    """The page of a map, of evaluations or of a pose graph: one HTML file without a network.

    It is that of `placegraph report`, `placegraph eval --report` and `placegraph graph optimize
    --report`. `title`: empty for the name of the map; `truth`: name of the truth of evaluations.
    """
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
        text, height = (escaped(str(each)) for each in (self.text, self.height))
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
