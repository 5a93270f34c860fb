"""Columns of the library as tables of pandas."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import _core
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


def trajectory_of_table(table: pandas.DataFrame) -> _core.Trajectory:
    """The trajectory of a table, whose columns are named as in a file that is read."""
    pandas = optional("pandas", "pandas")
    if not isinstance(table, pandas.DataFrame):
        raise _core.ArgumentError(f"table: a DataFrame is needed, not {type(table).__name__}")
    index = table.index
    is_time = pandas.api.types.is_datetime64_any_dtype(index)
    named = isinstance(index.name, str) and index.name not in table.columns
    if is_time or named or pandas.api.types.is_float_dtype(index):
        name = index.name if named else "timestamp"
        table = table.reset_index(names=name)
    columns = {}
    for name, values in table.items():
        if pandas.api.types.is_datetime64_any_dtype(values):
            # Whole nanoseconds since 1970, whatever the unit and the zone of the times.
            utc = pandas.to_datetime(values, utc=True).astype("datetime64[ns, UTC]")
            column = str(name) if str(name).endswith("_ns") else f"{name}_ns"
            columns[column] = utc.astype("int64")
        else:
            columns[str(name)] = values
    # As a file, so that the names of columns are those of files.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "table")
        pandas.DataFrame(columns).to_csv(path, index=False, na_rep="nan")
        try:
            trajectory = _core.read_evaluated(path)
        except _core.FileError as error:
            raise _core.FileError(str(error).replace(path, "table")) from None
    for text in trajectory.warnings:
        warnings.warn(text.replace(path, "table"), _core.Doubt, stacklevel=3)
    return trajectory
