"""KITTI's odometry benchmark: folders of estimates, judged as `placegraph eval kitti` does it.

    judged = pg.evaluate_kitti("kitti/poses", ["mine", "theirs"])
    judged.table.loc["mine"]
    judged.plot("00", "path")
    judged.write("judged")
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from ._estimates import existing
from ._notebook import escaped
from ._tables import table_of
from ._words import arguments_named

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from ._types import Path


class KittiEvaluation:
    """Submissions of one or several systems, with what is wrong with them.

    Evaluations are equal if all their figures, poses and faults are.
    """

    def __init__(self, core: _core.KittiBenchmark) -> None:
        self._core = core

    @property
    def ok(self) -> bool:
        """Whether every submission is free of faults."""
        return self._core.fault_count == 0

    def __bool__(self) -> bool:
        return self.ok

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, KittiEvaluation) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._core)

    @property
    def table(self) -> pandas.DataFrame:
        """The figures by system and sequence: frames, path_m, segments, t_rel_percent and
        r_rel_deg_per_100m. "mean" is over all segments of all sequences; NaN where a fault allows
        no figure.
        """
        table: pandas.DataFrame = table_of(self._core.figure_table()).set_index(
            ["system", "sequence"])
        return table

    @property
    def lengths(self) -> pandas.DataFrame:
        """Mean errors by system, sequence and length of the segments [m]."""
        return table_of(self._core.length_table())

    @property
    def speeds(self) -> pandas.DataFrame:
        """Mean errors by system, sequence and speed [m/s], in the devkit's overlapping intervals."""
        return table_of(self._core.speed_table())

    @property
    def faults(self) -> pandas.DataFrame:
        """What is wrong with the submissions: system, file, line (0: the whole file), text."""
        return table_of(self._core.fault_table())

    @property
    def warnings(self) -> pandas.DataFrame:
        """What seems wrong but is not against the form: system, file, line, text."""
        return table_of(self._core.warning_table())

    def picture(self, sequence: str = "avg", kind: str = "tl") -> _core.Figure:
        """The picture that `placegraph eval kitti --out` draws.

        `sequence`: its name, or "avg" for the means; `kind`: 'path', 'tl', 'rl' (errors over the
        length), 'ts' or 'rs' (over the speed). ArgumentError: no system has what it would show.
        """
        picture = self._core.figure(sequence, kind)
        if picture is None:
            raise _core.ArgumentError(f"sequence: there is nothing to draw as '{kind}' of "
                                      f"'{sequence}'")
        return picture

    def plot(self, sequence: str = "avg", kind: str = "tl") -> Figure:
        """The same picture as a matplotlib figure."""
        from ._figures import draw

        return draw(self.picture(sequence, kind))

    def write(self, folder: Path, *, format: str = "png", force: bool = False) -> None:
        """Writes the devkit's tables and plots into a folder, as `placegraph eval kitti --out`.

        `format`: 'png', 'svg', 'pdf', or 'none' for tables alone. ArgumentError: a submission has
        faults, or the folder holds files and `force` is False.
        """
        with arguments_named({"--force writes": "force=True writes"}):
            self._core.write(os.fspath(folder), format, force)

    def to_json(self) -> str:
        """The result as `placegraph eval kitti --json` prints it."""
        return self._core.to_json()

    def to_csv(self) -> str:
        """The figures as CSV, a row for each sequence of each system."""
        return self._core.to_csv()

    def __repr__(self) -> str:
        return str(self._core).rstrip("\n")

    def _repr_html_(self) -> str:
        return f"<pre>{escaped(repr(self))}</pre>"


def evaluate_kitti(
    truths: Path,
    estimates: Path | Sequence[Path],
    *,
    sequences: Sequence[str] = (),
) -> KittiEvaluation:
    """Judges submissions to KITTI's odometry benchmark as its devkit does.

    `truths` is a folder with `00.txt` ... or `00/poses.txt` ..., `estimates` such a folder or one
    for each system. `sequences`: those to judge; without them all of `truths`, and the form of
    estimates without truth. An estimate with a fault has no figures, and its system no mean. Warns
    with Doubt of every fault and of what seems wrong.
    """
    given = [estimates] if isinstance(estimates, (str, os.PathLike)) else estimates
    if not isinstance(given, Sequence) or isinstance(sequences, str):
        raise _core.ArgumentError("estimates and sequences: lists are needed")
    folders = [existing(each, "estimates") for each in given]
    judged = KittiEvaluation(
        _core.evaluate_kitti(existing(truths, "truth"), folders, list(sequences)))
    for table in (judged._core.fault_table(), judged._core.warning_table()):
        _warn(table)
    return judged


def _warn(table: dict[str, Any]) -> None:
    """Warns of the lines of a table at the line of the user's that called `evaluate_kitti`."""
    for file, line, text in zip(table["file"], table["line"], table["text"]):
        place = f"{file}:{line}" if line > 0 else file
        warnings.warn(f"{place}: {text}", _core.Doubt, stacklevel=3)
