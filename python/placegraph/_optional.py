"""Packages that are needed by some functions alone."""

from __future__ import annotations

import importlib
from typing import Any


def optional(package: str, extra: str) -> Any:
    """Imports a package; ImportError that says how to install it if it is missing."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise ImportError(
            f"{package} is needed here: pip install placegraph[{extra}] ({error})", name=package
        ) from error
