"""What a trajectory says about itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _core
from ._estimates import estimated_of, read_truth, true_of
from .datasets import Dataset

if TYPE_CHECKING:
    from ._estimates import EstimateLike, TruthLike
    from ._types import Path


def trajectory_info(
    trajectory: TruthLike | EstimateLike, times: Path | None = None
) -> _core.TrajectoryInfo:
    """Describes a trajectory without ground truth: rate, gaps, stops, jumps, likely conventions.

    `trajectory`: a Trajectory, a table of pandas, the file of one, a Dataset or the folder of a
    sequence with ground truth, or a Map. `times`: file of times for a trajectory without. The
    figures are those of `placegraph eval info`.
    """
    given = true_of(trajectory) if isinstance(trajectory, Dataset) else estimated_of(trajectory)
    return _core.trajectory_info(read_truth(given, "" if times is None else str(times)))
