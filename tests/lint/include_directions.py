"""include_directions.py ROOT: every include between folders is one that the table permits.

Prints one line for each violation, as file:line, and fails if there is one. The table is
ROOT/tests/lint/include_directions.txt, see include_table.py. Refused are
  an include that the table does not permit, or that leads through a parent folder,
  a folder of sources that has no line in the table, a line without a folder,
  a permission that no include uses,
  a folder of more than 30 sources,
  a table with an arrow that points up.
"""
import collections
import sys

from include_table import TABLE, read_table
from source_includes import folder_of, includes_of, source_files

MOST_FILES = 30


def check_folders(table, files):
    members = collections.defaultdict(list)
    for file in files:
        members[folder_of(file)].append(file)
    found = []
    for folder, inside in sorted(members.items()):
        if folder not in table.line_of:
            found.append(f"{inside[0]}:1: folder {folder} is missing in {TABLE}")
        if len(inside) > MOST_FILES:
            found.append(f"{inside[MOST_FILES]}:1: folder {folder} holds {len(inside)} sources, "
                         f"more than {MOST_FILES}: it holds more than one idea")
    found += [f"{TABLE}:{line}: folder {folder} holds no sources"
              for folder, line in table.line_of.items() if folder not in members]
    return found


def check_includes(root, table, files):
    """The violations, and the arrows between folders that the includes make."""
    found, arrows = [], set()
    for file in files:
        here = folder_of(file)
        for include in includes_of(root, file):
            if not include.target:
                if include.text.startswith("../") or "/../" in include.text:
                    found.append(f"{file}:{include.line}: "
                                 f"include by way of the parent folder: {include.text}")
                continue
            there = folder_of(include.target)
            arrows.add((here, there))
            if here in table.line_of and not table.permits(here, there):
                found.append(f"{file}:{include.line}: {here} may not include {include.text}")
    return found, arrows


def check(root):
    files = source_files(root)
    if not files:
        return [f"{root}: no sources"]
    table = read_table(root)
    found = [f"{TABLE}:{line}: {text}" for line, text in table.complaints]
    found += check_folders(table, files)
    violations, arrows = check_includes(root, table, files)
    found += violations
    for folder, permissions in table.allowed.items():
        found += [f"{TABLE}:{line}: no include uses the permission {folder} -> {there}"
                  for there, line in permissions.items() if (folder, there) not in arrows]
    return found


def main():
    found = check(sys.argv[1])
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
