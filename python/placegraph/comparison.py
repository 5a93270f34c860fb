"""Several estimates of one ground truth, or several sequences, judged together.

    judged = pg.compare("truth.tum", ["a.tum", "b.tum"])
    judged.table
    print(*judged.differences().sentence, sep="\n")
    pg.figure_table({"ours": judged}, ["ate_rmse_m"]).to_latex()
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from . import _core
from ._estimates import existing, named_estimates
from ._notebook import escaped
from ._tables import table_of
from .datasets import Dataset
from .evaluation import Evaluation, chosen_options, evaluated, read_both, warn_of, warned
from .options import EvaluationOptions

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from ._estimates import EstimateLike, TruthLike
    from ._types import Path


class Comparison(Sequence[Evaluation]):
    """Evaluations of several estimates of one ground truth, or of several sequences."""

    def __init__(self, results: Sequence[Evaluation], own_truths: bool,
                 common: Sequence[Evaluation] = ()) -> None:
        self._results = list(results)
        self._own = own_truths
        self._common = list(common)

    @property
    def own_truths(self) -> bool:
        """Whether each result is of a sequence of its own."""
        return self._own

    @property
    def common(self) -> Comparison | None:
        """The estimates on the frames that all of them have; None if they have the same ones.

        Figures of different frames do not compare.
        """
        return Comparison(self._common, False) if self._common else None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Comparison):
            return NotImplemented
        return self._own == other._own and self._results == other._results

    def __hash__(self) -> int:
        return hash((self._own, tuple(self._results)))

    def __len__(self) -> int:
        return len(self._results)

    def __iter__(self) -> Iterator[Evaluation]:
        return iter(self._results)

    @overload
    def __getitem__(self, which: int | str) -> Evaluation: ...

    @overload
    def __getitem__(self, which: slice) -> list[Evaluation]: ...

    def __getitem__(self, which: int | str | slice) -> Evaluation | list[Evaluation]:
        """A result by its index or its name; those of a slice."""
        if not isinstance(which, str):
            return self._results[which]
        for result in self._results:
            if result.name == which:
                return result
        raise KeyError(f"{which}: there are {', '.join(each.name for each in self)}")

    @property
    def table(self) -> pandas.DataFrame:
        """The figures, a row for each result and a column for each key."""
        columns: dict[str, list[Any]] = {"name": [each.name for each in self]}
        for key in self._results[0].values:
            columns[key] = [each.values[key] for each in self]
        table: pandas.DataFrame = table_of(columns).set_index("name")
        return table

    @property
    def average(self) -> dict[str, Any]:
        """Averages of the figures over the sequences; None where one of them failed.

        `failed` counts these, and `of_the_others` has the averages of the others. `pooled_t_rel`
        and `pooled_r_rel` are means over all segments of all sequences, as the KITTI devkit
        averages.
        """
        average = _core.average_results([each._core for each in self])
        figures = {row["key"]: row["value"] for row in average["means"]}
        for key in ("pooled_t_rel", "pooled_r_rel"):
            figures[key] = average[key]["value"]
        rest = {row["key"]: row["value"] for row in average["means_of_rest"]}
        return {"sequences": average["sequences"], "failed": average["failed"],
                "segments": average["segments"], "of_the_others": rest, **figures}

    def differences(self, level: float = 0.95) -> pandas.DataFrame:
        """Each further estimate against the first, on common frames, with the doubt in it.

        A row for each figure: first, second, ratio with its interval from low to high, p_value,
        difference ("none", "better", "worse", "below noise", "unknown") and a sentence. No
        difference below the noise of the true poses counts. ArgumentError: the results are of
        several sequences.
        """
        if self._own:
            raise _core.ArgumentError("differences are of estimates of one ground truth")
        judged = self._common or self._results
        return table_of(_core.compare_with_first([each._core for each in judged], level))

    def over_runs(self, level: float = 0.95) -> pandas.DataFrame:
        """Means and intervals over the results, taken as runs of one system over one drive.

        Indexed by figure; without an interval from fewer than five runs, and where a run failed.
        """
        columns = _core.intervals_of_repeated_runs([each._core for each in self], level)
        table: pandas.DataFrame = table_of(columns).set_index("figure")
        return table

    def picture(self, kind: str = "overview") -> _core.Figure:
        """The picture that `placegraph eval --plot-kind` draws."""
        return _core.evaluation_figure([each._core for each in self], kind, self._own)

    def plot(self, kind: str = "overview") -> Figure:
        """A matplotlib figure: 'overview', 'xyz', 'rpy', 'rpe', 'lengths', 'box' or 'violin'."""
        from ._figures import draw

        return draw(self.picture(kind))

    def to_json(self) -> str:
        """The results as `placegraph eval --json` prints them."""
        return _core.results_to_json([each._core for each in self], self._own,
                                     [each._core for each in self._common])

    def to_csv(self) -> str:
        """The results as CSV, one number per line."""
        return _core.results_to_csv([each._core for each in self])

    def to_latex(self) -> str:
        """A LaTeX table (booktabs), one row per result."""
        return _core.results_to_latex([each._core for each in self])

    def __repr__(self) -> str:
        table = _core.results_to_table([each._core for each in self], self._own)
        if self._common:
            table += "\non the frames that all estimates have:\n" + _core.results_to_table(
                [each._core for each in self._common])
        return "\n".join([table.rstrip("\n"), *warned(self._results)])

    def _repr_html_(self) -> str:
        text = f"<pre>{escaped(repr(self))}</pre>"
        return self.picture().to_svg() + text if any(each.ok for each in self) else text


def compare(
    truth: TruthLike,
    estimates: Mapping[str, EstimateLike] | Sequence[EstimateLike] | EstimateLike,
    *,
    align: str | None = None,
    deltas: str | Sequence[str] | None = None,
    all_pairs: bool = False,
    below: str | Sequence[str] | None = None,
    times: Path | Sequence[Path] | None = None,
    options: EvaluationOptions | None = None,
) -> Comparison:
    """Evaluates several estimates of one ground truth, or all sequences of a folder.

    `estimates`: what `evaluate` takes, by names, or a list of it, where "estimate 1", ... are the
    names of trajectories and maps; or one folder, whose files are paired by name with those of the
    folder `truth`. Estimates of different frames of one truth are judged on common ones, too; see
    `Comparison.common`. Other arguments as of `evaluate`. Warns with Doubt of what is suspicious in
    the data, and of an estimate without figures, without which there is no mean over all;
    NoResult: none has figures.
    """
    chosen = chosen_options(options, align, deltas, all_pairs, below)
    if isinstance(estimates, (str, os.PathLike)):
        folder = existing(estimates, "estimates")
        if os.path.isdir(folder) and not _core.is_run_folder(folder):
            if isinstance(truth, (_core.Trajectory, Dataset)) or not os.path.isdir(
                    truths := existing(truth, "truth")):
                raise _core.ArgumentError("truth: a folder is needed, as estimates is one")
            return _compared([evaluated(true, estimate, name, times, chosen)
                              for name, true, estimate in _core.pair_files(truths, folder)], True)
    both = [read_both(truth, each, name, times, chosen)
            for name, each in named_estimates(estimates)]
    results = [Evaluation(_core.evaluate_trajectory(*each[:2], chosen, each[2])) for each in both]
    common = _core.evaluate_common_frames([each[0] for each in both], [each[1] for each in both],
                                          [each[2] for each in both], chosen)
    return _compared(results, False, [Evaluation(each) for each in common])


def _compared(results: Sequence[Evaluation], own_truths: bool,
              common: Sequence[Evaluation] = ()) -> Comparison:
    failed = [each for each in results if not each.ok]
    if results and len(failed) == len(results):
        raise _core.NoResult("; ".join(f"{each.name}: {each.reason}" for each in failed))
    for each in results:
        warn_of(each)
    for each in failed:
        warnings.warn(f"{each.name} has no figures, so that there is no mean over all: "
                      f"{each.reason}", _core.Doubt, stacklevel=3)
    if common:
        warnings.warn("the estimates are of different frames: compare them by `common`",
                      _core.Doubt, stacklevel=3)
    return Comparison(results, own_truths, common)


def figure_table(
    systems: Mapping[str, Comparison | Evaluation],
    figures: Sequence[str] = ("ate_rmse_m",),
    *,
    rows: str = "sequences",
) -> _core.FigureTable:
    """A table of figures of systems on sequences, as `placegraph eval table` makes it.

    `systems`: by their names, comparisons of a folder of sequences, or evaluations of one.
    `figures`: keys as "ate_rmse_m". `rows`: 'sequences' or 'systems'. Failures keep their cells,
    and no mean leaves one out without saying so.
    """
    given = []
    for name, results in systems.items():
        each = [results] if isinstance(results, Evaluation) else list(results)
        given.append((name, [(one.name if len(each) > 1 else "sequence", one._core)
                             for one in each]))
    return _core.table_of_systems(given, list(figures), rows)
