"""Evaluation of trajectories against ground truth, as `placegraph eval` does it.

    result = pg.evaluate(dataset.ground_truth, map.trajectory(), align="se3")
    print(result["ate_rmse_m"], result.protocol)
    result.frames.plot(x="travelled_m", y="error_m")
    result.plot("rpe")
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

    @property
    def rpe_heading_deg(self) -> _core.Statistics | None:
        """Statistics of their part about the vertical [deg]; None if none is evident."""
        return self._core.rpe_heading_deg

    @property
    def rpe_inclination_deg(self) -> _core.Statistics | None:
        """Statistics of the angles between the two up directions [deg]; None without a vertical."""
        return self._core.rpe_inclination_deg

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

        heading_deg and inclination_deg are missing if no vertical is evident.
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

    def intervals(self, level: float = 0.95) -> pandas.DataFrame:
        """Confidence intervals of the relative figures, from the scatter along the drive.

        Indexed by figure: estimate, low, high, level, of, reason. Low and high are NaN where the
        data allow none, for that reason. An ATE of one run has none.
        """
        columns = _core.intervals_of_drive(self._core, level)
        table: pandas.DataFrame = table_of(columns).set_index("figure")
        return table

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
        return "\n".join([str(self._core).rstrip("\n"), *warned([self])])

    def _repr_html_(self) -> str:
        core = self._core
        doubts = [("warning", text) for text in core.warnings]
        if not core.ok:
            return table_html([(core.name, core.reason), *doubts])
        rows = [(row["name"], f"{row['value']:.6g} {row['unit']}") for row in core.metric_rows()
                if row["value"] is not None] + doubts
        return figure_html(rows, self.picture().to_svg())


def warned(results: Sequence[Evaluation]) -> list[str]:
    """The lines on what is suspicious in the data of evaluations."""
    return [f"warning: {each.name}: {text}" for each in results for text in each.warnings]


def warn_of(result: Evaluation) -> None:
    """Warns at the line of the user's that called `evaluate` or `compare`."""
    for text in result.warnings:
        warnings.warn(f"{result.name}: {text}", _core.Doubt, stacklevel=3)


def chosen_options(options: EvaluationOptions | None, align: str | None,
             deltas: str | Sequence[str] | None, all_pairs: bool,
             below: str | Sequence[str] | None = None) -> _core.OptionSet:
    chosen = given_or_default(options, EvaluationOptions)._set.copy()
    if align is not None:
        chosen.set("align", align)
    if deltas is not None:
        chosen.set("relative.deltas", deltas if isinstance(deltas, str) else ",".join(deltas))
    if all_pairs:
        chosen.set("relative.pairs", "all")
    if below is not None:
        chosen.set("below", below if isinstance(below, str) else ",".join(below))
    return chosen


def evaluate(
    truth: TruthLike,
    estimate: EstimateLike,
    *,
    align: str | None = None,
    deltas: str | Sequence[str] | None = None,
    all_pairs: bool = False,
    below: str | Sequence[str] | None = None,
    name: str | None = None,
    times: Path | Sequence[Path] | None = None,
    options: EvaluationOptions | None = None,
) -> Evaluation:
    """Evaluates a trajectory against the ground truth: ATE, RPE and KITTI segment errors.

    `truth`: a Trajectory, the file of one, a Dataset, or the folder of a sequence; `estimate`: a
    Trajectory, the file of one, a Map, or the output folder of a run. `align`: 'none', 'origin',
    'se3' (the default), 'sim3', 'scale' or 'yaw'; it takes precedence over that of `options`.
    `deltas`: lengths of steps of further relative errors, as '1s', '10f', '5m' or '10deg'; with
    `all_pairs` a step begins at every pose. `below`: bounds of errors, as '0.1m' or '1deg', for the
    shares of the drive below them ("below_0.1m_frames", "below_0.1m_path"). `times`: file of
    times for trajectories without, or two, for truth and estimate. Warns with Doubt of what is
    suspicious in the data. NoResult: the data allow no figures.
    """
    chosen = chosen_options(options, align, deltas, all_pairs, below)
    result = evaluated(truth, estimate, name, times, chosen)
    warn_of(result)
    if not result.ok:
        raise _core.NoResult(f"{result.name}: {result.reason}")
    return result


def evaluated(
    truth: TruthLike,
    estimate: EstimateLike,
    name: str | None,
    times: Path | Sequence[Path] | None,
    chosen: _core.OptionSet,
) -> Evaluation:
    """The evaluation, also without figures."""
    true, estimated, name = read_both(truth, estimate, name, times, chosen)
    return Evaluation(_core.evaluate_trajectory(true, estimated, chosen, name))


def read_both(
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
