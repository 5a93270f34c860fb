"""Scores of place recognizers and loop closures against the true ones.

    from placegraph import loops

    truth = loops.LoopTruth.from_poses(dataset.ground_truth)
    result = loops.score((query, candidate, score), truth)
    print(result["ap"], result.curve["recall"])
    result.plot()
"""

from __future__ import annotations

import copy
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from . import _core
from ._core import LoopTruth
from ._notebook import figure_html
from ._tables import table_of
from ._types import Path
from .options import given_or_default, kinds

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from .slam import RecognizerArgument

    Predictions: TypeAlias = (
        Path | Mapping[str, ArrayLike] | pandas.DataFrame | Sequence[ArrayLike])
    Truth: TypeAlias = Path | LoopTruth | _core.Trajectory

__all__ = ["LoopScore", "LoopTruth", "RevisitOptions", "match", "read_predictions", "score"]

_KEYS = ("positives", "answered", "hits", "misses", "dropped", "unjudged", "r_at_1", "r_at_5",
         "r_at_10", "ap", "recall_at_100p", "f1_max")


class RevisitOptions(kinds.RevisitOptions):
    """Criteria for a revisit of a place, of `LoopTruth.from_poses`."""

    __slots__ = ()
    _kind = _core.RevisitOptionSet


class LoopScore:
    """The figures of a place recognizer over a set of images; `result["ap"]` is one of them.

    Scores are equal if their names and all their figures are.
    """

    def __init__(self, core: _core.LoopBenchmark, name: str, protocol: str = "") -> None:
        self._core = core
        self._name = name
        self._protocol = protocol

    @property
    def name(self) -> str:
        """Name of the predictions."""
        return self._name

    @property
    def protocol(self) -> str:
        """How the predictions were judged."""
        return self._protocol

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, LoopScore):
            return NotImplemented
        return self._name == other._name and self._core == other._core

    def __hash__(self) -> int:
        return hash((self._name, self._core))

    @property
    def curve(self) -> dict[str, NDArray[Any]]:
        """The precision-recall curve: threshold, hits, misses, precision, recall; N each."""
        return self._core.curve_table()

    @property
    def queries(self) -> pandas.DataFrame:
        """The queries: query, has_match, verdict, candidate, score, rank.

        `verdict`: hit, miss, silent, too_young or out_of_range; `rank`: that of the first true
        candidate, from 1, or 0.
        """
        return table_of(self._core.query_table())

    @property
    def reliability(self) -> dict[str, Any]:
        """Agreement of scores that are probabilities with the share of right candidates.

        By tenths of the probability: candidates, mean_probability, share_right; and
        calibration_error. Raises ArgumentError for scores outside 0 to 1.
        """
        return self._core.reliability_table()

    @property
    def metrics(self) -> dict[str, float | None]:
        """All figures by their keys in `placegraph loops --json`; None: not defined."""
        core, curve = self._core, self.curve
        last = len(curve["hits"]) - 1
        counts = [int(curve[key][last]) if last >= 0 else 0 for key in ("hits", "misses")]
        values = (core.positives, core.predicted_queries, *counts, core.dropped, core.unjudged,
                  *core.recall_at, core.average_precision, core.recall_at_full_precision,
                  core.f1_max)
        return dict(zip(_KEYS, values))

    def __getitem__(self, key: str) -> float | None:
        """A figure by its key, as "ap"; None if it is not defined."""
        metrics = self.metrics
        if key not in metrics:
            raise KeyError(f"{key}: no such figure; there are {', '.join(metrics)}")
        return metrics[key]

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws precision over recall with matplotlib, into `axes` or a figure of its own."""
        import numpy

        from ._figures import pyplot

        if axes is None:
            _, axes = pyplot().subplots(figsize=(5.6, 5.6))
        curve = self.curve
        recall = numpy.concatenate([[0.0], numpy.repeat(curve["recall"], 2)])[:-1]
        precision = numpy.repeat(curve["precision"], 2)
        average = self["ap"]
        label = self.name if average is None else f"{self.name}: AP {average:.3f}"
        axes.plot(recall, precision, label=label)
        axes.set(xlabel="recall", ylabel="precision", xlim=(0, 1.02), ylim=(0, 1.02))
        axes.grid(True, color="0.9")
        axes.legend(loc="lower left")
        return axes

    def __repr__(self) -> str:
        def text(value: float | None) -> str:
            return "none" if value is None else f"{value:.4g}"

        figures = ", ".join(f"{key} {text(value)}" for key, value in self.metrics.items())
        return f"<placegraph.loops.LoopScore {self.name}: {figures}>"

    def _repr_html_(self) -> str:
        rows = [(key, f"{value:.6g}") for key, value in self.metrics.items() if value is not None]
        return figure_html(rows, _core.precision_recall_picture(self._core, self.name,
                                                                self.protocol))


def match(images: Iterable[NDArray[np.uint8]], recognizer: RecognizerArgument, *,
          min_age: int = 300) -> pandas.DataFrame:
    """The older image that resembles each image most: query, candidate, score.

    `images`: H x W, or H x W x 3 (BGR), uint8. `recognizer`: a function from an image to a vector,
    or another that `Slam` takes. Candidates are at least `min_age` images older.
    """
    return table_of(_core.match_images(images, recognizer, min_age))


def read_predictions(path: Path, format: str = "scores") -> pandas.DataFrame:
    """Predictions of a file: query, candidate, score.

    `format`: 'scores' (lines `query candidate score`), 'ibow' or 'run' (loops.csv of a run).
    """
    return table_of(_core.read_loop_predictions(os.fspath(path), format))


def _columns(predictions: Predictions, format: str) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
    if isinstance(predictions, (str, os.PathLike)):
        predictions = _core.read_loop_predictions(os.fspath(predictions), format)
    if isinstance(predictions, Mapping) or hasattr(predictions, "columns"):
        table: Any = predictions
        for name in ("query", "candidate", "score"):
            if name not in table:
                raise _core.ArgumentError(f"predictions: there is no column {name}")
        return table["query"], table["candidate"], table["score"]
    if not isinstance(predictions, Sequence) or len(predictions) != 3:
        raise _core.ArgumentError(
            "predictions: three arrays (query, candidate, score), a table of them or a file are "
            "needed")
    return predictions[0], predictions[1], predictions[2]


def _truth(truth: Truth, options: RevisitOptions | None, min_age: int | None) -> LoopTruth:
    if isinstance(truth, LoopTruth):
        if options is not None or min_age is not None:
            raise _core.ArgumentError(
                "truth: options and min_age are those of the LoopTruth that is given")
        return truth
    if isinstance(truth, _core.Trajectory):
        chosen = given_or_default(options, RevisitOptions)
        if min_age is not None:
            chosen = copy.deepcopy(chosen)
            chosen.min_age = min_age
        return LoopTruth.from_poses(truth, chosen)
    if not isinstance(truth, (str, os.PathLike)):
        raise _core.ArgumentError("truth: a LoopTruth, a Trajectory or a file is needed")
    return LoopTruth.read(os.fspath(truth), min_age)


def score(
    predictions: Predictions,
    truth: Truth,
    *,
    tolerance: int = 0,
    min_age: int | None = None,
    options: RevisitOptions | None = None,
    format: str = "scores",
    name: str = "predictions",
) -> LoopScore:
    """Judges the loop closures that a place recognizer proposed for a set of images.

    `predictions`: arrays query, candidate and score (N each), a table with these columns, or a
    file in a `format` of `read_predictions`. A query's prediction is its best candidate; it is a
    hit if it is within `tolerance` images of a true match. `truth`: a LoopTruth, the file of one,
    or true poses, of which `options` say what is a revisit. `min_age`: candidates less than this
    many images before the query are neither hits nor misses; by default 300, and 0 for a file that
    lists the candidates of each query. Warns with Doubt of predictions that are not judged;
    NoResult: no query has a true match.
    """
    query, candidate, scores = _columns(predictions, format)
    true = _truth(truth, options, min_age)
    judged = _core.judge_loops(true, query, candidate, scores, tolerance)
    if not judged.ok:
        raise _core.NoResult(f"{name}: {judged.reason}")
    for doubt in judged.doubts:
        warnings.warn(f"{name}: {doubt}", _core.Doubt, stacklevel=2)
    kind = "true poses" if isinstance(truth, _core.Trajectory) else "listed matches"
    return LoopScore(judged, name, f"{kind}, candidates at least {true.min_age} images older")
