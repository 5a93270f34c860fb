"""test_share.py ROOT: every folder of sources has at least LEAST lines of unit tests a line.

The unit tests of `backend/solver` lie in `tests/unit/backend/solver`. Prints a line for each folder with fewer, and exits with 1 if there is one.
"""
import collections
import pathlib
import sys

from source_includes import LAYERS

LEAST = 0.3


def lines_in(root, folders):
    """Lines of the C++ files by folder."""
    lines = collections.Counter()
    for folder in folders:
        for path in (root / folder).rglob("*"):
            if path.suffix in (".h", ".cpp"):
                lines[path.relative_to(root).parent.as_posix()] += path.read_bytes().count(b"\n")
    return lines


root = pathlib.Path(sys.argv[1])
sources = lines_in(root, LAYERS)
tests = lines_in(root / "tests/unit", LAYERS)
few = [f"{folder}: {tests[folder]} lines of unit tests for {lines} lines, {LEAST * lines:.0f} are the least"
       for folder, lines in sorted(sources.items()) if tests[folder] < LEAST * lines]
print("\n".join(few) or f"test_share: {len(sources)} folders, all with {LEAST} lines of unit tests a line or more")
sys.exit(1 if few else 0)
