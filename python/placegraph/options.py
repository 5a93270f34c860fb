"""Options as nested objects, with the defaults, ranges and meanings of the C++ library.

    options = pg.RunOptions()
    options.loops.enabled = False
    options.odometry.window.max_keyframes = 12      # ranges are checked here
    print(options.to_yaml())

Type checkers and editors know every option with its type and meaning: the classes of
`_option_types.pyi`, which a build writes (python/tools/option_types.py), are bases for them alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _core
from ._option_group import OptionGroup, Options, given_or_default

if TYPE_CHECKING:
    from . import _option_types as kinds
else:

    class _Kinds:
        def __getattr__(self, name: str) -> type[Options]:
            return Options

    kinds = _Kinds()

__all__ = [
    "EvaluationOptions",
    "IncrementalOptions",
    "LocalizerOptions",
    "OptionGroup",
    "Options",
    "PlaceRecognizerOptions",
    "PoseGraphOptions",
    "RunOptions",
    "SequenceFilterOptions",
    "SlamOptions",
    "given_or_default",
    "kinds",
]


class RunOptions(kinds.RunOptions):
    """Options of `run`."""

    __slots__ = ()
    _kind = _core.RunOptionSet


class SlamOptions(kinds.SlamOptions):
    """Options of `Slam`."""

    __slots__ = ()
    _kind = _core.SlamOptionSet


class LocalizerOptions(kinds.LocalizerOptions):
    """Options of `localize`."""

    __slots__ = ()
    _kind = _core.LocalizerOptionSet


class EvaluationOptions(kinds.EvaluationOptions):
    """Options of `evaluate`."""

    __slots__ = ()
    _kind = _core.EvaluationOptionSet


class PoseGraphOptions(kinds.PoseGraphOptions):
    """Options of `optimize`."""

    __slots__ = ()
    _kind = _core.PoseGraphOptionSet


class IncrementalOptions(kinds.IncrementalOptions):
    """Options of `IncrementalOptimizer`."""

    __slots__ = ()
    _kind = _core.IncrementalOptionSet


class PlaceRecognizerOptions(kinds.PlaceRecognizerOptions):
    """Options of `PlaceRecognizer`."""

    __slots__ = ()
    _kind = _core.PlaceRecognizerOptionSet


class SequenceFilterOptions(kinds.SequenceFilterOptions):
    """Options of `SequenceFilter`."""

    __slots__ = ()
    _kind = _core.SequenceFilterOptionSet
