"""Files and folders in which `evaluate` finds trajectories."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from . import _core
from ._types import Path
from .datasets import Dataset
from .maps import Map

if TYPE_CHECKING:
    TrajectoryLike: TypeAlias = _core.Trajectory | Path
    TruthLike: TypeAlias = TrajectoryLike | Dataset
    EstimateLike: TypeAlias = TrajectoryLike | Map


def is_run(path: str) -> bool:
    return os.path.exists(os.path.join(path, "trajectory_optimized.kitti"))


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


def true_of(given: TruthLike) -> TrajectoryLike:
    """The true trajectory of a dataset; a trajectory or a path as it is."""
    if not isinstance(given, Dataset):
        return given
    truth = given.ground_truth
    if truth is None:
        raise _core.ArgumentError(f"truth: the dataset {given.name} has no ground truth")
    return truth


def estimated_of(given: EstimateLike) -> TrajectoryLike:
    """The trajectory of a map; a trajectory or a path as it is."""
    return given.trajectory() if isinstance(given, Map) else given


def named_estimates(
    given: Mapping[str, EstimateLike] | Iterable[EstimateLike] | EstimateLike
) -> list[tuple[str, EstimateLike]]:
    """The estimates of a comparison with their names: those given, of files, or by number."""
    if isinstance(given, Mapping):
        named = list(given.items())
    else:
        if isinstance(given, (str, os.PathLike, _core.Trajectory, Map)):
            given = [given]
        elif not isinstance(given, Iterable):
            raise _core.ArgumentError(
                f"estimates: a list or a dictionary is needed, not {type(given).__name__}")
        estimates = list(given)
        paths = {i: existing(each, "estimates") for i, each in enumerate(estimates)
                 if not isinstance(each, (_core.Trajectory, Map))}
        names = dict(zip(paths, short_names(list(paths.values()))))
        named = [(names.get(i, f"estimate {i + 1}"), each) for i, each in enumerate(estimates)]
    if not named:
        raise _core.ArgumentError("estimates: there is none")
    return named


def read_truth(given: TrajectoryLike, times: str) -> tuple[_core.Trajectory, str]:
    """The truth, and the file of times that is beside the poses of a KITTI sequence."""
    if isinstance(given, _core.Trajectory):
        return given, ""
    path = existing(given, "truth")
    if os.path.isdir(path):
        poses = os.path.join(path, "poses.txt")
        if not os.path.exists(poses):
            truth = _core.open_dataset(path).ground_truth
            if truth is None:
                raise _core.FileError(f"{path}: the sequence has no ground truth")
            return truth, ""
        path = poses
    beside = os.path.join(os.path.dirname(path), "times.txt")
    is_sequence = os.path.basename(path) == "poses.txt" and os.path.exists(beside)
    return _core.read_evaluated(path, times), beside if is_sequence else ""


def read_estimate(given: TrajectoryLike, truth: TrajectoryLike, times: str) -> _core.Trajectory:
    if isinstance(given, _core.Trajectory):
        return given
    path = existing(given, "estimate")
    if os.path.isdir(path):
        if not is_run(path):
            raise _core.ArgumentError(
                f"estimate: {path} is a folder without trajectory_optimized.kitti")
        path = os.path.join(path, f"trajectory_optimized.{_format_for(truth)}")
    return _core.read_evaluated(path, times)


def _format_for(truth: TrajectoryLike) -> str:
    """The file of a run that has times where the truth has them."""
    if isinstance(truth, _core.Trajectory):
        return "tum" if truth.has_times else "kitti"
    path = os.fspath(truth)
    timed = (os.path.isdir(path) or path.endswith((".tum", ".csv"))
             or os.path.exists(os.path.join(os.path.dirname(path), "times.txt")))
    return "tum" if timed else "kitti"


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


def _partner(truth: str, candidates: Sequence[str]) -> str | None:
    """The file of the same name, or else the only one of the same stem."""
    if truth in candidates:
        return truth
    stem = os.path.splitext(truth)[0]
    same = [each for each in candidates if os.path.splitext(each)[0] == stem]
    if len(same) > 1:
        raise _core.ArgumentError(
            f"estimates: both {same[0]} and {same[-1]} could be the estimate of {truth}")
    return same[0] if same else None


def _files(folder: str) -> list[str]:
    return sorted(each.name for each in os.scandir(folder)
                  if each.is_file() and not each.name.startswith("."))


def pairs_of_files(truth: str, estimates: str) -> dict[str, tuple[str, str]]:
    """Files of two folders with the same name."""
    candidates = _files(estimates)
    pairs = {}
    for file in _files(truth):
        partner = _partner(file, candidates)
        if partner is not None:
            pairs[os.path.splitext(file)[0]] = (os.path.join(truth, file),
                                                os.path.join(estimates, partner))
    if not pairs:
        raise _core.ArgumentError(
            f"estimates: no file of {estimates} has the name of one in {truth}")
    return pairs


def short_names(paths: Sequence[str]) -> list[str]:
    """The first of file name, folder name and path that no other estimate shares."""
    files = [os.path.basename(os.path.normpath(path)) for path in paths]
    folders = [os.path.basename(os.path.dirname(os.path.normpath(path))) for path in paths]
    return [file if files.count(file) == 1 else
            folder if folder and folders.count(folder) == 1 else path
            for path, file, folder in zip(paths, files, folders)]
