"""What the package offers by its name alone."""

import subprocess
import sys
import types

import pytest

import placegraph as pg
from placegraph._words import without_flags


@pytest.mark.parametrize("name", ["bag", "colmap", "gtsam", "rerun"])
def test_modules_are_imported_when_they_are_used(name: str) -> None:
    script = ("import sys, placegraph as pg\n"
              f"assert 'placegraph.{name}' not in sys.modules and '{name}' in dir(pg)\n"
              f"print(pg.{name}.__name__)\n")
    if name == "bag":
        pytest.importorskip("rosbags")
    done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True,
                          text=True)
    assert done.stdout == f"placegraph.{name}\n"


def test_names_are_public_or_modules() -> None:
    assert set(pg.__all__) <= set(dir(pg))
    assert {"from_networkx", "to_networkx", "show", "page_of"} <= set(pg.__all__)
    assert callable(pg.show) and callable(pg.page_of)
    for name in set(dir(pg)) - set(pg.__all__):
        assert name.startswith("_") or isinstance(getattr(pg, name), types.ModuleType), name
    with pytest.raises(AttributeError, match="no_such_name"):
        getattr(pg, "no_such_name")


def test_flags_become_arguments_and_paths_stay() -> None:
    text = "--max-size: a/--voxel and -- stay (--cell); x: exists; --force replaces it"
    assert without_flags(text, {"--max-size": "size"}) == (
        "size: a/--voxel and -- stay (cell); x: exists; force=True replaces it")
