"""Evaluation of trajectories against ground truth, as `placegraph eval` does it.

    result = pg.evaluate(dataset.ground_truth, map.trajectory(), align="se3")
    print(result["ate_rmse_m"], result.protocol)
    result.frames.plot(x="travelled_m", y="error_m")
    result.plot("rpe")
    pg.compare("truth.tum", ["a.tum", "b.tum"]).table
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from . import _core
from ._estimates import (
    estimated_of,
    existing,
    files_of_times,
    named_estimates,
    read_estimate,
    read_truth,
    times_beside,
    true_of,
)
from ._notebook import escaped, figure_html, table_html
from ._tables import table_of
from .datasets import Dataset
from .options import EvaluationOptions, given_or_default

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from ._estimates import EstimateLike, TruthLike
    from ._types import Path


class Evaluation:
    """One estimated trajectory evaluated against one ground truth.

    Evaluations are equal if all their figures are, NaN included.
    """

    def __init__(self, core: _core.EvaluationResult) -> None:
        self._core = core

    @property
    def name(self) -> str:
        """Name of the estimate."""
        return self._core.name

    @property
    def ok(self) -> bool:
        """Whether the figures are meaningful; `reason` says why not."""
        return self._core.ok

    @property
    def reason(self) -> str:
        """Why there are no figures; empty otherwise."""
        return self._core.reason

    @property
    def warnings(self) -> tuple[str, ...]:
        """Suspicious properties of the data, one line each."""
        return self._core.warnings

    @property
    def protocol(self) -> dict[str, Any]:
        """How the figures were computed: align, association, max_difference_s, lengths_m, step."""
        return self._core.protocol

    @property
    def alignment(self) -> _core.AlignmentResult:
        """The transformation that was fitted: scale, rotation, translation."""
        return self._core.alignment

    @property
    def ape_m(self) -> _core.Statistics | None:
        """Statistics of the position errors after the alignment [m]; the rmse is the ATE."""
        return self._core.ape_m

    @property
    def are_deg(self) -> _core.Statistics | None:
        """Statistics of the absolute rotation errors after the alignment [deg]."""
        return self._core.are_deg

    @property
    def rpe_m(self) -> _core.Statistics | None:
        """Statistics of the errors in translation between consecutive frames [m]."""
        return self._core.rpe_m

    @property
    def rpe_deg(self) -> _core.Statistics | None:
        """Statistics of the errors in rotation between consecutive frames [deg]."""
        return self._core.rpe_deg

    def __bool__(self) -> bool:
        return self._core.ok

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, Evaluation) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._core)

    def __getitem__(self, key: str) -> float | None:
        """A figure by its key, as "ate_rmse_m"; None if the data allow none.

        NoResult: the evaluation has no figures at all.
        """
        if not self.ok:
            raise _core.NoResult(f"{self.name}: {self.reason}")
        figures = self.values
        if key not in figures:
            raise KeyError(f"{key}: no such figure; there are {', '.join(figures)}")
        return figures[key]

    @property
    def values(self) -> dict[str, float | None]:
        """All figures by their keys; None where the data allow none."""
        return {row["key"]: row["value"] for row in self._core.metric_rows()}

    @property
    def metrics(self) -> pandas.DataFrame:
        """All figures: key, name, unit, value, protocol."""
        rows = self._core.metric_rows()
        return table_of({key: [row[key] for row in rows] for key in rows[0]})

    @property
    def frames(self) -> pandas.DataFrame:
        """The evaluated frames: frame, stamp_ns, travelled_m, and errors (NaN where lost).

        error_m and error_deg are those of position and rotation; along_m, across_m and up_m the
        position errors with signs by the direction of the true path.
        """
        return table_of(self._core.frame_table())

    def frame_table(self) -> dict[str, Any]:
        """The same with truth and aligned estimate (N x 4 x 4) as arrays."""
        return self._core.frame_table()

    @property
    def errors(self) -> pandas.DataFrame:
        """Statistics of every kind of error, a row each: rmse, mean, median, ..., p99."""
        table: pandas.DataFrame = table_of(self._core.error_table()).set_index("key")
        return table

    def steps(self, delta: str = "1f") -> pandas.DataFrame:
        """The relative errors of each step over a delta of the evaluation: '1s', '10f', '5m'.

        ArgumentError: the evaluation was not asked for that delta.
        """
        return table_of(self._core.step_table(delta))

    def by(self, what: str) -> pandas.DataFrame:
        """ATE and RPE in intervals of 'speed' [m/s], 'turning_rate' [deg/s] or 'distance' [m]."""
        return table_of(self._core.profile_table(what))

    @property
    def worst(self) -> pandas.DataFrame:
        """The stretches of the hundredth of frames with the largest position errors."""
        return table_of(self._core.worst_table())

    @property
    def segments(self) -> pandas.DataFrame:
        """The segments of t_rel and r_rel (KITTI)."""
        return table_of(self._core.segment_table())

    @property
    def lengths(self) -> pandas.DataFrame:
        """Mean errors of the segments of each length [m]."""
        return table_of(self._core.length_table())

    @property
    def speeds(self) -> pandas.DataFrame:
        """Mean errors of the segments in each interval of speed [m/s]."""
        return table_of(self._core.speed_table())

    def save_for_evo(self, path: Path, reference: str = "reference") -> None:
        """Writes the position errors as a result archive of evo (.zip), as evo_ape does.

        `reference` is the name of the ground truth in it. NoResult: there are no figures.
        """
        _core.write_evaluation_for_evo(os.fspath(path), self._core, reference)

    def picture(self, kind: str = "overview") -> _core.Figure:
        """The picture that `placegraph eval --plot-kind` draws; `to_svg()` is its text."""
        return _core.evaluation_figure([self._core], kind)

    def plot(self, kind: str = "overview") -> Figure:
        """A matplotlib figure: 'overview', 'xyz', 'rpy', 'rpe', 'lengths', 'box' or 'violin'."""
        from ._figures import draw

        return draw(self.picture(kind))

    def to_json(self) -> str:
        """The result as `placegraph eval --json` prints it."""
        return self._core.to_json()

    def __repr__(self) -> str:
        return "\n".join([str(self._core).rstrip("\n"), *_warned([self])])

    def _repr_html_(self) -> str:
        core = self._core
        doubts = [("warning", text) for text in core.warnings]
        if not core.ok:
            return table_html([(core.name, core.reason), *doubts])
        rows = [(row["name"], f"{row['value']:.6g} {row['unit']}") for row in core.metric_rows()
                if row["value"] is not None] + doubts
        return figure_html(rows, self.picture().to_svg())


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
        return "\n".join([table.rstrip("\n"), *_warned(self._results)])

    def _repr_html_(self) -> str:
        text = f"<pre>{escaped(repr(self))}</pre>"
        return self.picture().to_svg() + text if any(each.ok for each in self) else text


def _warned(results: Sequence[Evaluation]) -> list[str]:
    """The lines on what is suspicious in the data of evaluations."""
    return [f"warning: {each.name}: {text}" for each in results for text in each.warnings]


def _warn(result: Evaluation) -> None:
    """Warns at the line of the user's that called `evaluate` or `compare`."""
    for text in result.warnings:
        warnings.warn(f"{result.name}: {text}", _core.Doubt, stacklevel=3)


def _options(options: EvaluationOptions | None, align: str | None,
             deltas: str | Sequence[str] | None, all_pairs: bool) -> _core.OptionSet:
    chosen = given_or_default(options, EvaluationOptions)._set.copy()
    if align is not None:
        chosen.set("align", align)
    if deltas is not None:
        chosen.set("relative.deltas", deltas if isinstance(deltas, str) else ",".join(deltas))
    if all_pairs:
        chosen.set("relative.pairs", "all")
    return chosen


def evaluate(
    truth: TruthLike,
    estimate: EstimateLike,
    *,
    align: str | None = None,
    deltas: str | Sequence[str] | None = None,
    all_pairs: bool = False,
    name: str | None = None,
    times: Path | Sequence[Path] | None = None,
    options: EvaluationOptions | None = None,
) -> Evaluation:
    """Evaluates a trajectory against the ground truth: ATE, RPE and KITTI segment errors.

    `truth`: a Trajectory, the file of one, a Dataset, or the folder of a sequence; `estimate`: a
    Trajectory, the file of one, a Map, or the output folder of a run. `align`: 'none', 'origin',
    'se3' (the default), 'sim3', 'scale' or 'yaw'; it takes precedence over that of `options`.
    `deltas`: lengths of steps of further relative errors, as '1s', '10f', '5m' or '10deg'; with
    `all_pairs` a step begins at every pose. `times`: file of times for trajectories without, or
    two, for truth and estimate. Warns with Doubt of what
    is suspicious in the data. NoResult: the data allow no figures.
    """
    result = _evaluated(truth, estimate, name, times, _options(options, align, deltas, all_pairs))
    _warn(result)
    if not result.ok:
        raise _core.NoResult(f"{result.name}: {result.reason}")
    return result


def _evaluated(
    truth: TruthLike,
    estimate: EstimateLike,
    name: str | None,
    times: Path | Sequence[Path] | None,
    chosen: _core.OptionSet,
) -> Evaluation:
    """The evaluation, also without figures."""
    true, estimated, name = _read_both(truth, estimate, name, times, chosen)
    return Evaluation(_core.evaluate_trajectory(true, estimated, chosen, name))


def _read_both(
    truth: TruthLike,
    estimate: EstimateLike,
    name: str | None,
    times: Path | Sequence[Path] | None,
    chosen: _core.OptionSet,
) -> tuple[_core.Trajectory, _core.Trajectory, str]:
    """The two trajectories and the name of the estimate."""
    truth_times, estimate_times = files_of_times(times)
    truth, estimate = true_of(truth), estimated_of(estimate)
    if name is None:
        name = "estimate"
        if not isinstance(estimate, _core.Trajectory):
            name = os.path.basename(os.path.normpath(existing(estimate, "estimate")))
    estimated = read_estimate(estimate, truth, estimate_times)
    # A KITTI sequence stores its times beside its poses; they are needed if the estimate has times.
    if not truth_times and estimated.has_times and chosen.get("associate") != "index":
        truth_times = times_beside(truth)
    return read_truth(truth, truth_times), estimated, name


def compare(
    truth: TruthLike,
    estimates: Mapping[str, EstimateLike] | Sequence[EstimateLike] | EstimateLike,
    *,
    align: str | None = None,
    deltas: str | Sequence[str] | None = None,
    all_pairs: bool = False,
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
    chosen = _options(options, align, deltas, all_pairs)
    if isinstance(estimates, (str, os.PathLike)):
        folder = existing(estimates, "estimates")
        if os.path.isdir(folder) and not _core.is_run_folder(folder):
            if isinstance(truth, (_core.Trajectory, Dataset)) or not os.path.isdir(
                    truths := existing(truth, "truth")):
                raise _core.ArgumentError("truth: a folder is needed, as estimates is one")
            return _compared([_evaluated(true, estimate, name, times, chosen)
                              for name, true, estimate in _core.pair_files(truths, folder)], True)
    both = [_read_both(truth, each, name, times, chosen)
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
        _warn(each)
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
