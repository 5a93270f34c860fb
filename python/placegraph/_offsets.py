"""Constant offsets between the bodies and the clocks of two trajectories."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _core
from ._estimates import estimated_of, read_estimate, read_truth, true_of

if TYPE_CHECKING:
    from ._estimates import EstimateLike, TruthLike


def estimate_offsets(
    truth: TruthLike,
    estimate: EstimateLike,
    *,
    body: bool = True,
    time: bool = True,
    scale: bool = False,
    start_s: float = 0.0,
) -> _core.OffsetEstimate:
    """Estimates the constant pose between two bodies and the time between their clocks.

    `truth`, `estimate`: as of `evaluate`. `body`, `time`: what is estimated; `scale`: fitted along;
    `start_s`: known beforehand, added to the estimate's stamps. The result is that of `placegraph
    eval --estimate`; its `ok` is false, with a `reason`, where the motions show nothing. Evaluate
    `with_offsets(estimate, result)`. ArgumentError: neither is to be estimated, or stamps go back.
    """
    true = true_of(truth)
    estimated = read_estimate(estimated_of(estimate), true, "")
    return _core.estimate_offsets(read_truth(true, ""), estimated, body, time, scale, start_s)
