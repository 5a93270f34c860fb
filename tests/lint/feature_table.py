"""feature_table.py ROOT: the tests that the table of features of docs/evaluation.md names exist.

Reads the table below the heading "Beside other tools". The last cell of a row has a file of a test in
backticks, by its name alone, and perhaps a name that stands in it; `-` is for what this project lacks.
Prints one line for each violation as file:line, and fails if there is one.
"""
import glob
import os
import re
import sys

DOCUMENT = "docs/evaluation.md"
HEADING = "Beside other tools"
FOLDERS = ("tests", "python/tests", "scripts/test.d")


def files_named(root, name):
    return [path for folder in FOLDERS
            for path in glob.glob(os.path.join(glob.escape(root), folder, "**", name), recursive=True)]


def fault_of(root, cells, columns):
    """What is wrong with a row, or nothing."""
    if len(cells) != columns or "" in cells:
        return f"{len(cells) - cells.count('')} cells, the head has {columns}"
    if cells[-1] == "-":
        return None if cells[1] == "no" else "no test"
    named = re.findall(r"`([^`]+)`", cells[-1])
    files = files_named(root, glob.escape(named[0])) if named else []
    if not files:
        return f"no such test: {cells[-1]}"
    for name in named[1:]:
        if not any(name in open(path, encoding="utf-8").read() for path in files):
            return f"{named[0]} has no {name}"
    return None


def main():
    root, columns, rows, found = sys.argv[1], 0, 0, []
    with open(os.path.join(root, DOCUMENT), encoding="utf-8") as text:
        lines = text.read().split("\n")
    below = False
    for number, line in enumerate(lines, 1):
        below = line.lstrip("# ") == HEADING if line.startswith("#") else below
        if not below or not line.startswith("|") or line.startswith("|--"):
            continue
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        fault = fault_of(root, cells, columns) if columns else None
        rows += bool(columns)
        columns = columns or len(cells)
        if fault:
            found.append(f"{DOCUMENT}:{number}: {fault}")
    for line in found if rows else [f"{DOCUMENT}: no table below '{HEADING}'"]:
        print(line)
    return 1 if found or not rows else 0


sys.exit(main())
