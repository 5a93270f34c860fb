"""Files and folders in which `evaluate` finds trajectories."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from . import _core
from ._types import Path
from .datasets import Dataset
from .maps import Map

if TYPE_CHECKING:
    import pandas

    TrajectoryLike: TypeAlias = _core.Trajectory | pandas.DataFrame | Path
    TruthLike: TypeAlias = TrajectoryLike | Dataset
    EstimateLike: TypeAlias = TrajectoryLike | Map


def existing(given: object, argument: str) -> str:
    if not isinstance(given, (str, os.PathLike)):
        other = "Dataset" if argument == "truth" else "Map"
        raise _core.ArgumentError(f"{argument}: a Trajectory, a {other} or a path is needed, not "
                                  f"{type(given).__name__}")
    path = os.fspath(given)
    if not isinstance(path, str):
        raise _core.ArgumentError(f"{argument}: the path must be a text")
    if not os.path.exists(path):
        raise _core.FileError(f"{path}: no such file or folder")
    return path


def _is_table(given: object) -> bool:
    """Whether it is a DataFrame of pandas, which need not be imported."""
    return hasattr(given, "to_csv") and hasattr(given, "columns")


def _of_table(given: TrajectoryLike) -> TrajectoryLike:
    """The trajectory of a table of pandas; a trajectory or a path as it is."""
    return _core.Trajectory.from_pandas(cast(Any, given)) if _is_table(given) else given


def true_of(given: TruthLike) -> TrajectoryLike:
    """The true trajectory of a dataset or of a table; a trajectory or a path as it is."""
    if not isinstance(given, Dataset):
        return _of_table(given)
    truth = given.ground_truth
    if truth is None:
        raise _core.ArgumentError(f"truth: the dataset {given.name} has no ground truth")
    return truth


def estimated_of(given: EstimateLike) -> TrajectoryLike:
    """The trajectory of a map or of a table; a trajectory or a path as it is."""
    return given.trajectory() if isinstance(given, Map) else _of_table(given)


def named_estimates(
    given: Mapping[str, EstimateLike] | Iterable[EstimateLike] | EstimateLike
) -> list[tuple[str, EstimateLike]]:
    """The estimates of a comparison with their names: those given, of files, or by number."""
    if isinstance(given, Mapping):
        named = list(given.items())
    else:
        if isinstance(given, (str, os.PathLike, _core.Trajectory, Map)) or _is_table(given):
            given = [cast(Any, given)]
        elif not isinstance(given, Iterable):
            raise _core.ArgumentError(
                f"estimates: a list or a dictionary is needed, not {type(given).__name__}")
        estimates = list(given)
        paths = {i: existing(each, "estimates") for i, each in enumerate(estimates)
                 if not isinstance(each, (_core.Trajectory, Map)) and not _is_table(each)}
        names = dict(zip(paths, _core.distinct_names(list(paths.values()))))
        named = [(names.get(i, f"estimate {i + 1}"), each) for i, each in enumerate(estimates)]
    if not named:
        raise _core.ArgumentError("estimates: there is none")
    return named


def read_truth(given: TrajectoryLike, times: str) -> _core.Trajectory:
    if isinstance(given, _core.Trajectory):
        return given
    return _core.read_truth(existing(given, "truth"), times)


def times_beside(given: TrajectoryLike) -> str:
    """The file of times beside the poses of a KITTI sequence; empty: there is none."""
    return "" if isinstance(given, _core.Trajectory) else _core.times_beside(existing(given, "truth"))


def read_estimate(given: TrajectoryLike, truth: TrajectoryLike, times: str) -> _core.Trajectory:
    if isinstance(given, _core.Trajectory):
        return given
    path = existing(given, "estimate")
    if os.path.isdir(path):
        if not _core.is_run_folder(path):
            raise _core.ArgumentError(
                f"estimate: {path} is a folder without trajectory_optimized.kitti")
        timed = (truth.has_times if isinstance(truth, _core.Trajectory)
                 else _core.truth_has_times(os.fspath(cast(Any, truth))))
        path = _core.trajectory_of_run(path, timed)
    return _core.read_evaluated(path, times)


def files_of_times(times: Path | Sequence[Path] | None) -> tuple[str, str]:
    """The files of times of the truth and of the estimate."""
    if times is None:
        return "", ""
    if isinstance(times, (str, os.PathLike)):
        return os.fspath(times), os.fspath(times)
    if not isinstance(times, Sequence) or len(times) != 2 or not all(
            isinstance(each, (str, os.PathLike)) for each in times):
        raise _core.ArgumentError(
            f"times: one file, or two (truth, estimate), are needed, not {times!r}")
    return os.fspath(times[0]), os.fspath(times[1])
