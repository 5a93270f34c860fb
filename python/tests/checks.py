"""What tests of several subjects use."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
import pytest

Value = TypeVar("Value")


def some(value: Value | None) -> Value:
    """A value that must be there."""
    assert value is not None
    return value


def wrong(value: object) -> Any:
    """A value of another type than the one that is declared."""
    return value


def properties(value: Any) -> dict[str, Any]:
    """What the properties of an object and of what they give have, by their names."""
    found: dict[str, Any] = {}
    kind = type(value)
    if not kind.__module__.startswith("placegraph"):
        return found
    for name in dir(kind):
        if name.startswith("_") or not isinstance(getattr(kind, name), property):
            continue
        try:
            given = getattr(value, name)
        except (ValueError, ImportError):  # not defined for this value
            continue
        found[name] = given
        parts = given.items() if isinstance(given, dict) else (
            enumerate(given) if isinstance(given, tuple) else ())
        for key, part in parts:
            found[f"{name}[{key!r}]"] = part
        for key, part in list(properties(given).items()):
            found[f"{name}.{key}"] = part
    return found


def assert_read_only(value: Any) -> None:
    """What an object and its properties give are tuples, and arrays that cannot be written to."""
    for key, given in properties(value).items():
        assert not isinstance(given, list) or key.endswith("]"), key
        if isinstance(given, np.ndarray) and given.size > 0:
            with pytest.raises(ValueError, match="read-only"):
                given[...] = 0
