"""Is this change a regression? Records of runs, and their judgement by the rules of a team.

    before = pg.read_record("baseline.json")
    after = pg.record("truth.tum", ["run1.tum", "run2.tum"], name="town")
    judged = pg.gate(before, after, rules=["* | ate_rmse_m | worse 5 %"])
    assert judged, judged.sentence
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from . import _core
from ._estimates import named_estimates
from ._notebook import escaped
from ._tables import table_of
from ._words import arguments_named
from .evaluation import Evaluation, chosen_options, read_both, warn_of
from .options import EvaluationOptions

if TYPE_CHECKING:
    import pandas

    from ._estimates import EstimateLike, TruthLike
    from ._types import Path


class Record:
    """Figures of the runs of a system, as `placegraph eval record` keeps them in a file.

    Records are equal if their files are.
    """

    def __init__(self, core: _core.RunRecord) -> None:
        self._core = core

    @property
    def programs(self) -> tuple[str, ...]:
        """Versions that made the figures, each once."""
        return self._core.programs

    @property
    def failures(self) -> dict[str, list[str]]:
        """By sequence, a line for each run without a result: which, and why."""
        return self._core.failures

    @property
    def figures(self) -> pandas.DataFrame:
        """The figures by sequence and key: unit, better, runs, failed, mean, low, high, noise_floor.

        From low to high is the interval of the mean, NaN where the runs allow none; the noise floor
        is what the noise of the truth adds.
        """
        table: pandas.DataFrame = table_of(self._core.figure_table()).set_index(
            ["sequence", "figure"])
        return table

    def values(self, sequence: str, figure: str) -> list[float | None]:
        """The values of a figure, one for each run; None: the run has none.

        ArgumentError: there is no such sequence or figure.
        """
        return self._core.values(sequence, figure)

    def with_runs(self, more: Record) -> Record:
        """A record with the runs of another one behind its own, and sequences that it lacks.

        ArgumentError: they were judged by another truth, or with other options.
        """
        return Record(self._core.with_runs(_record_of(more, "more")._core))

    def to_json(self) -> str:
        """The text of the record's file, a line for each figure."""
        return self._core.to_json()

    def save(self, path: Path, *, force: bool = False) -> None:
        """Writes the record. ArgumentError: the file exists and `force` is False."""
        with arguments_named({}):
            _core.write_record(self._core, os.fspath(path), force)

    def __eq__(self, other: object) -> bool:
        return self.to_json() == other.to_json() if isinstance(other, Record) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __repr__(self) -> str:
        runs = {name: len(lines) for name, lines in self.failures.items()}
        parts = ", ".join(name + (f" ({count} failed)" if count else "")
                          for name, count in runs.items())
        return f"<placegraph.Record of {', '.join(self.programs) or 'a system'}: {parts}>"


class GateResult:
    """A candidate judged against a baseline; true if nothing regressed and all could be judged."""

    def __init__(self, core: _core.GateJudgement) -> None:
        self._core = core

    @property
    def exit_code(self) -> int:
        """0 all right, 1 regressed, 2 cannot be judged."""
        return self._core.exit_code

    @property
    def ok(self) -> bool:
        """Whether no figure regressed and every one could be judged."""
        return self.exit_code == 0

    @property
    def sentence(self) -> str:
        """The verdict in a line."""
        return self._core.sentence

    @property
    def figures(self) -> pandas.DataFrame:
        """The judged figures, the worst first: verdict, before, after, rule, reason, runs_needed."""
        return table_of(self._core.figure_table())

    def to_json(self) -> str:
        """The judgement as `placegraph eval gate --json` prints it."""
        return self._core.to_json()

    def to_markdown(self) -> str:
        """A page for a pull request: what regressed first, the rest folded."""
        return self._core.to_markdown()

    def to_junit(self) -> str:
        """JUnit's XML with a test case for each figure."""
        return self._core.to_junit()

    def __bool__(self) -> bool:
        return self.ok

    def __eq__(self, other: object) -> bool:
        return self.to_json() == other.to_json() if isinstance(other, GateResult) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __repr__(self) -> str:
        return self._core.to_text().rstrip("\n")

    def _repr_html_(self) -> str:
        return f"<pre>{escaped(repr(self))}</pre>"


def record(
    truth: TruthLike,
    runs: Mapping[str, EstimateLike] | Iterable[EstimateLike] | EstimateLike,
    *,
    name: str = "sequence",
    programs: Sequence[str] = (),
    align: str | None = None,
    deltas: str | Sequence[str] | None = None,
    all_pairs: bool = False,
    below: str | Sequence[str] | None = None,
    times: Path | Sequence[Path] | None = None,
    options: EvaluationOptions | None = None,
) -> Record:
    """Judges the runs of a system over one sequence and records their figures.

    `runs`: what `evaluate` takes, one or several. `name`: that of the sequence. `programs`:
    versions of the system, to be noted beside that of placegraph. Other arguments as of
    `evaluate`. A run that the data allow no figure is a failed run of the record. Warns with Doubt
    of what is suspicious in the data.
    """
    chosen = chosen_options(options, align, deltas, all_pairs, below)
    both = [read_both(truth, each, run, times, chosen) for run, each in named_estimates(runs)]
    judged = [Evaluation(_core.evaluate_trajectory(*each[:2], chosen, each[2])) for each in both]
    for each in judged:
        warn_of(each)
    return Record(_core.record_of_runs(name, both[0][0], [each._core for each in judged],
                                       [*programs, f"placegraph {_core.version}"]))


def read_record(path: Path) -> Record:
    """Reads the file of a record. FileError: it is none, with the place of what is wrong."""
    return Record(_core.read_record(os.fspath(path)))


def gate(
    baseline: Record | Path,
    candidates: Record | Path | Iterable[Record | Path],
    *,
    rules: Path | Sequence[str] | None = None,
    level: float = 0.05,
    power: float = 0.80,
) -> GateResult:
    """Judges records of a candidate against that of a baseline, as `placegraph eval gate` does.

    `baseline`, `candidates`: records or their files; several candidates are runs of one system.
    `rules`: a file of rules, or a list of their lines; None: those of the command. `level`:
    the probability that an equal candidate is called worse; `power`: that of finding an effect, by
    which runs are counted. ArgumentError, FileError: one line that names the place.
    """
    before = _record_of(baseline, "baseline")
    given: list[Record | Path]
    if isinstance(candidates, (Record, str, os.PathLike)):
        given = [candidates]
    else:
        given = list(candidates)
    after = [_record_of(each, "candidates") for each in given]
    names = [f"candidate {i + 1}" if isinstance(each, Record) else os.fspath(each)
             for i, each in enumerate(given)]
    if rules is None:
        parsed = _core.default_gate_rules()
    elif isinstance(rules, (str, os.PathLike)):
        parsed = _core.read_gate_rules(os.fspath(rules))
    else:
        parsed = _core.parse_gate_rules("\n".join(rules), "rules")
    return GateResult(_core.judge_records(before._core, [each._core for each in after], names,
                                          parsed, level, power))


def _record_of(given: Record | Path, argument: str) -> Record:
    if isinstance(given, Record):
        return given
    if not isinstance(given, (str, os.PathLike)):
        raise _core.ArgumentError(
            f"{argument}: a record or the file of one is needed, not {type(given).__name__}")
    return read_record(given)
