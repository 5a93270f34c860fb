"""Columns of the library as tables of pandas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._optional import optional

if TYPE_CHECKING:
    import pandas


def table_of(columns: Mapping[str, Any]) -> pandas.DataFrame:
    """A DataFrame of columns; arrays N x 2 and N x 3 become columns of their parts x, y, z.

    Larger arrays, such as poses, are left out.
    """
    flat: dict[str, Any] = {}
    for name, values in columns.items():
        dimensions = getattr(values, "ndim", 1)
        if dimensions == 1:
            flat[name] = values
        elif dimensions == 2 and values.shape[1] <= 3:
            for part, axis in zip(values.T, "xyz"):
                flat[f"{name}_{axis}"] = part
    table: pandas.DataFrame = optional("pandas", "pandas").DataFrame(flat)
    return table
