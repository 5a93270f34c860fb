"""What tests of several subjects use."""

from __future__ import annotations

from typing import Any, TypeVar

Value = TypeVar("Value")


def some(value: Value | None) -> Value:
    """A value that must be there."""
    assert value is not None
    return value


def wrong(value: object) -> Any:
    """A value of another type than the one that is declared."""
    return value
