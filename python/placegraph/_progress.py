"""Progress of calls that last."""

from __future__ import annotations

import contextlib
import importlib
import itertools
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias, Union

from . import _core


class Progress(NamedTuple):
    """How far a call is: what its `progress` is called with."""

    done: int
    """Frames, images or steps that are done."""
    total: int | None
    """How many there are; None if that is not known."""
    text: str
    """What was done last, as "iteration 3: cost 12.5"; empty if there is nothing to say."""


ProgressArgument: TypeAlias = Union[bool, Callable[[Progress], object], None]
"""True: a bar of tqdm, or a line on stderr without it; a function is called with a Progress."""

Report: TypeAlias = Callable[[int, "int | None", str], None]


@contextlib.contextmanager
def reporting(progress: ProgressArgument, name: str, unit: str) -> Iterator[Report | None]:
    """What a call tells its progress to; None if nobody asks for it."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        shown = _bar(name, unit) or _Line(name, unit)
        try:
            yield shown.show
        finally:
            shown.close()
    elif callable(progress):
        function = progress

        def told(done: int, total: int | None, text: str) -> None:
            function(Progress(done, total, text))

        yield told
    else:
        raise _core.ArgumentError(f"progress: True, False or a function is needed, not {progress!r}")


def counted(report: Report) -> Callable[[str], None]:
    """A function that counts the lines that it is called with; how many will come is unknown."""
    numbers = itertools.count(1)
    return lambda line: report(next(numbers), None, line)


class _Line:
    """One line on stderr, which is written anew at most ten times a second."""

    def __init__(self, name: str, unit: str) -> None:
        self._name, self._unit = name, unit
        self._text, self._width, self._at = "", 0, 0.0

    def show(self, done: int, total: int | None, text: str) -> None:
        of = "" if total is None else f" of {total}"
        self._text = f"{self._name}: {done}{of} {self._unit}" + (f", {text}" if text else "")
        if time.monotonic() >= self._at + 0.1:
            self._write()

    def _write(self) -> None:
        self._at = time.monotonic()
        sys.stderr.write("\r" + self._text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(self._text)

    def close(self) -> None:
        if self._text:
            self._write()
            sys.stderr.write("\n")


class _Bar:
    """A bar of tqdm."""

    def __init__(self, tqdm: Callable[..., Any], name: str, unit: str) -> None:
        self._bar = tqdm(desc=name, unit=f" {unit}", file=sys.stderr)

    def show(self, done: int, total: int | None, text: str) -> None:
        bar = self._bar
        bar.total = total
        bar.set_postfix_str(text, refresh=False)
        bar.update(done - bar.n)

    def close(self) -> None:
        self._bar.close()


def _bar(name: str, unit: str) -> _Bar | None:
    try:
        return _Bar(importlib.import_module("tqdm").tqdm, name, unit)
    except ImportError:
        return None
