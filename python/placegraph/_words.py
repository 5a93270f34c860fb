"""Flags of the command line in messages, as the arguments of Python that they are."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from . import _core

_FORCE = {"--force overwrites": "force=True overwrites", "--force replaces": "force=True replaces"}


def without_flags(text: str, names: Mapping[str, str]) -> str:
    """The text with `names` replaced, and then every other --flag by the argument of its name."""
    for flag, argument in {**names, **_FORCE}.items():
        text = text.replace(flag, argument)
    flag = r"(?<![^\s(])--([a-z]+(?:-[a-z]+)*)"
    return re.sub(flag, lambda found: found[1].replace("-", "_"), text)


@contextmanager
def arguments_named(names: Mapping[str, str]) -> Iterator[None]:
    """Lets errors of the library name arguments in place of flags."""
    try:
        yield
    except (_core.ArgumentError, _core.FileError) as error:
        raise type(error)(without_flags(str(error), names)) from None
