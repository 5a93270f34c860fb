"""The notebooks run from top to bottom, on data that they make themselves.

Their outputs are committed, so that they can be read where nothing runs;
`PLACEGRAPH_WRITE_NOTEBOOKS=1` writes the present ones.
"""

import os
import pathlib
import re
from typing import Any

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).resolve().parents[1] / "notebooks").glob("*.ipynb"))
MOST_BYTES = 400_000
WRITE = os.environ.get("PLACEGRAPH_WRITE_NOTEBOOKS") == "1"


def read(path: pathlib.Path) -> Any:
    return pytest.importorskip("nbformat").read(path, as_version=4)


def kinds_of(notebook: Any) -> list[list[list[str]]]:
    """For each cell the kinds of its outputs: names of streams, or types of the data."""
    return [[sorted(output["data"]) if "data" in output else [output["name"]]
             for output in cell.get("outputs", ())] for cell in notebook.cells]


def test_there_are_notebooks() -> None:
    assert [path.stem for path in NOTEBOOKS] == [
        "evaluation", "false_loops", "first_drive", "own_recognizer"]


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_runs_from_top_to_bottom(path: pathlib.Path, tmp_path: pathlib.Path) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook, stored = read(path), read(path)
    client = nbclient.NotebookClient(
        notebook, timeout=300, record_timing=False, coalesce_streams=True,
        resources={"metadata": {"path": str(tmp_path)}})
    client.execute()
    for output in (output for cell in notebook.cells for output in cell.get("outputs", ())):
        if output.get("name") == "stderr":
            assert "Doubt: " in output["text"], "a warning that is no doubt of the package's"
            output["text"] = re.sub(r"/\S*ipykernel_\S*: ", "", output["text"])
    if WRITE:
        notebook.metadata.language_info = {"name": "python"}
        nbformat.write(notebook, path)
        return
    assert kinds_of(notebook) == kinds_of(stored)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_was_executed_and_is_small(path: pathlib.Path) -> None:
    code = [cell for cell in read(path).cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    assert any(cell.outputs for cell in code)
    assert path.stat().st_size <= MOST_BYTES
