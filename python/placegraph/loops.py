"""Scores of place recognizers and loop closures against the true ones.

    from placegraph import loops

    truth = loops.LoopTruth.from_poses(dataset.ground_truth)  # one drive that meets itself
    result = loops.score((query, candidate, score), truth)
    print(result["ap"], result.curve["recall"])
    result.plot()

    truth = loops.LoopTruth.between(queries, database)  # positions of two sets of images
    result = loops.score((indices, distances), truth, scores="distance")  # a search's N x K arrays
"""

from __future__ import annotations

import copy
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from . import _core
from ._core import ImageSet, LoopTruth
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
    Truth: TypeAlias = Path | LoopTruth | _core.Trajectory | ArrayLike

__all__ = ["ImageSet", "LoopScore", "LoopTruth", "RevisitOptions", "match", "read_array",
           "read_predictions", "score", "truth_of_lists"]

_KEYS = ("positives", "answered", "hits", "misses", "dropped", "unjudged", "queries",
         "r_at_1", "r_at_5", "r_at_10", "r_at_20",
         "r_at_1_of_all", "r_at_5_of_all", "r_at_10_of_all", "r_at_20_of_all",
         "ap", "ap_of_answers", "auc_of_answers", "recall_at_100p", "f1_max")


class RevisitOptions(kinds.RevisitOptions):
    """Criteria for a revisit of a place, of `LoopTruth.from_poses` and `LoopTruth.between`."""

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
                  len(core.query_table()["query"]), *core.recall_at, *core.recall_at_of_all,
                  core.average_precision, core.average_precision_of_answers, core.area_of_answers,
                  core.recall_at_full_precision, core.f1_max)
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


def read_array(path: Path, name: str | None = None) -> NDArray[Any]:
    """The array of a file of numpy (.npy, .npz), MATLAB (.mat) or HDF5 (.h5, .hdf5).

    `name`: the array to read, where a file has several. Nothing is unpickled. MATLAB's files need
    scipy, or h5py from version 7.3 on, and so do those of HDF5. Raises FileError for a file that has
    no such array, or several and no `name`.
    """
    import numpy

    path = os.fspath(path)
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".npy":
        return _unpickled(path, lambda: numpy.load(path, allow_pickle=False))
    if suffix == ".npz":
        with numpy.load(path, allow_pickle=False) as archive:
            chosen = _chosen(path, list(archive.files), name)
            return _unpickled(path, lambda: archive[chosen])
    if suffix == ".mat":
        from scipy import io

        try:
            arrays = io.loadmat(path)
        except NotImplementedError:  # version 7.3 is HDF5, with transposed arrays
            turned: NDArray[Any] = _of_hdf5(path, name).T
            return turned
        names = [key for key in arrays if not key.startswith("__")]
        return numpy.asarray(arrays[_chosen(path, names, name)])
    return _of_hdf5(path, name)


def _unpickled(path: str, load: Callable[[], Any]) -> NDArray[Any]:
    try:
        loaded: NDArray[Any] = load()
        return loaded
    except ValueError as error:
        raise _core.FileError(
            f"{path}: has objects of Python, which are not unpickled: load the file yourself if you "
            "trust it (numpy.load with allow_pickle), and give the array") from error


def _of_hdf5(path: str, name: str | None) -> NDArray[Any]:
    import h5py

    with h5py.File(path, "r") as file:
        names: list[str] = []
        file.visititems(lambda key, item: names.append(key)
                        if isinstance(item, h5py.Dataset) and item.ndim > 0 else None)
        loaded: NDArray[Any] = file[_chosen(path, names, name)][()]
        return loaded


def _chosen(path: str, names: list[str], name: str | None) -> str:
    if name is None and len(names) == 1:
        return names[0]
    if name is None or name not in names:
        wanted = "one array" if name is None else f"an array {name}"
        raise _core.FileError(f"{path}: {wanted} is needed, there are {', '.join(sorted(names))}")
    return name


_ARRAY_FILES = (".npz", ".mat", ".h5", ".hdf5")


def _is_array_file(path: object) -> bool:
    return (isinstance(path, (str, os.PathLike))
            and os.path.splitext(os.fspath(path))[1].lower() in _ARRAY_FILES)


def truth_of_lists(
    rows: Sequence[tuple[int, Sequence[int]]] | NDArray[Any], *, min_age: int = 0,
    within: bool | None = None,
) -> LoopTruth:
    """The truth of pairs of a query and its matches, as VPR-Bench's array (N x 2) holds them.

    Queries with no matches are listed with none. `min_age` and `within` as of `LoopTruth`.
    """
    matches = {int(query): sorted({int(match) for match in found}) for query, found in rows}
    return LoopTruth(matches, min_age=min_age, within=within)


def read_predictions(
    path: Path, format: str = "scores", *, top_k_scores: Path | None = None,
    queries: ImageSet | None = None, database: ImageSet | None = None,
) -> pandas.DataFrame:
    """Predictions of a file: query, candidate, score.

    `format`: 'scores' (lines `query candidate score`, with a header or without), 'ibow', 'run'
    (loops.csv of a run), 'topk' (the best candidates of a query in a row, with `top_k_scores` of the
    same shape) or 'matrix' (the score of each pair). `queries` and `database`: images whose names
    stand in the file.
    """
    columns, _ = _core.read_loop_predictions(
        os.fspath(path), format, "" if top_k_scores is None else os.fspath(top_k_scores), queries,
        database)
    return table_of(columns)


def _columns(predictions: Predictions, format: str) -> tuple[Any, str | None]:
    """Columns query, candidate and score, and what the scores are said to be."""
    import numpy

    given: Any = predictions
    if _is_array_file(given):
        given = read_array(given)
    if isinstance(given, (str, os.PathLike)):
        return _core.read_loop_predictions(os.fspath(given), format)
    if isinstance(given, Mapping) or hasattr(given, "columns"):
        table: Any = given
        names = list(table)
        last = "distance" if "score" not in names and "distance" in names else "score"
        for name in ("query", "candidate", last):
            if name not in names:
                raise _core.ArgumentError(f"predictions: there is no column {name}")
        kind = "distance" if last == "distance" else None
        return {key: table[of] for key, of in
                (("query", "query"), ("candidate", "candidate"), ("score", last))}, kind
    if isinstance(given, numpy.ndarray) and given.ndim == 2:
        return _core.matrix_columns(given), None
    if not isinstance(given, Sequence) or len(given) not in (2, 3):
        raise _core.ArgumentError(
            "predictions: three arrays (query, candidate, score), candidates and scores of a search "
            "(Q x K), a matrix of scores, a table or a file are needed")
    if len(given) == 2:
        if numpy.ndim(given[0]) != 2 or numpy.ndim(given[1]) != 2:
            raise _core.ArgumentError("predictions: two arrays are the candidates and scores of a "
                                      "search, Q x K each")
        return _core.search_columns(given[0], given[1]), None
    return dict(zip(("query", "candidate", "score"), given)), None


def _truth(truth: Truth, options: RevisitOptions | None, min_age: int | None,
           within: bool | None) -> LoopTruth:
    import numpy

    if isinstance(truth, LoopTruth):
        if options is not None or min_age is not None or within is not None:
            raise _core.ArgumentError(
                "truth: options, min_age and within are those of the LoopTruth that is given")
        return truth
    if isinstance(truth, _core.Trajectory):
        chosen = given_or_default(options, RevisitOptions)
        if min_age is not None:
            chosen = copy.deepcopy(chosen)
            chosen.min_age = min_age
        return LoopTruth.from_poses(truth, chosen)
    if _is_array_file(truth):
        truth = read_array(truth)  # type: ignore[arg-type]
    if isinstance(truth, (str, os.PathLike)):
        return LoopTruth.read(os.fspath(truth), min_age, within)
    if isinstance(truth, numpy.ndarray) and truth.ndim == 2:
        if not numpy.isin(truth, (0, 1)).all():
            raise _core.ArgumentError("truth: a matrix of matches has values other than 0 and 1")
        return LoopTruth.from_matrix(truth.astype(bool), min_age, within)
    raise _core.ArgumentError(
        "truth: a LoopTruth, a Trajectory, a matrix (N x M) of matches or a file is needed")


def score(
    predictions: Predictions,
    truth: Truth,
    *,
    tolerance: int = 0,
    min_age: int | None = None,
    within: bool | None = None,
    scores: str | None = None,
    options: RevisitOptions | None = None,
    format: str = "scores",
    name: str = "predictions",
) -> LoopScore:
    """Judges the loop closures that a place recognizer proposed for a set of images.

    `predictions`: arrays query, candidate and score (N each), a table with these columns, arrays
    candidate and score of a search (Q x K, -1: none), a matrix of scores (Q x M, NaN: none), or a
    file in a `format` of `read_predictions`. A query's prediction is its best candidate; it is a hit
    if it is within `tolerance` images of a true match. `truth`: a LoopTruth, a matrix of matches
    (Q x M), the file of one, or true poses, of which `options` say what is a revisit. `min_age`:
    candidates less than this many images before the query are neither hits nor misses; by default
    300, and 0 for a file that lists the candidates of each query; 0 or `within` False: candidates
    are images of a database. `scores`: 'similarity' or 'distance' (the smallest is best); by default
    as the column is called, else similarity. Warns with Doubt of predictions that are not judged and
    of scores that seem to be distances; NoResult: no query has a true match.
    """
    columns, kind = _columns(predictions, format)
    true = _truth(truth, options, min_age, within)
    judged = _core.judge_loops(true, columns["query"], columns["candidate"], columns["score"],
                               tolerance, scores or kind or "similarity")
    if not judged.ok:
        raise _core.NoResult(f"{name}: {judged.reason}")
    for doubt in judged.doubts:
        warnings.warn(f"{name}: {doubt}", _core.Doubt, stacklevel=2)
    source = "true poses" if isinstance(truth, _core.Trajectory) else "listed matches"
    protocol = f"{judged.protocol}: {source}"
    if true.min_age > 0 and judged.protocol == "within one drive":
        protocol += f", candidates at least {true.min_age} images older"
    return LoopScore(judged, name, protocol)
