"""include_directions.py ROOT: every include between folders is one that the table permits.

Prints one line for each violation, as file:line, and fails if there is one. The table is
ROOT/tests/lint/include_directions.txt, see include_table.py. Refused are
  an include that the table does not permit, or that leads through a parent folder,
  a folder of sources that has no line in the table, a line without a folder,
  a permission that no include uses,
  a folder of more than 30 sources, or of the name `internal`, which divides an idea,
  a table with an arrow that points up,
  a source of apps that includes the option parser or prints and is no part of the command line
  (cmd_*, main.cpp, help.*, command_line.*, shell/*): a command is a function, arguments in and result out.
"""
import collections
import os
import re
import sys

from include_table import TABLE, read_table
from source_includes import ALL_DOORS, folder_of, includes_of, layer_of, source_files, without_comments

MOST_FILES = 30
COMMAND_LINE = re.compile(r"apps/(.*/)?cmd_[^/]*|apps/(main\.cpp|(help|command_line)\.(h|cpp)|shell/[^/]*)")
PARSES = {"apps/support/calib_option.h", "apps/support/calib_option.cpp"}  # an option of many commands
PRINTS = {"apps/support/output.cpp", "apps/support/progress.cpp"}  # what the others print through
STRING = re.compile(r'"(?:\\.|[^"\\\n])*"')
PRINT = re.compile(r"std::(cout|cerr|clog)\b|fmt::print(ln)?\s*\("
                   r"|(?<![A-Za-z0-9_])(v?f?printf|puts|fputs|putchar|fputc|perror|fwrite)\s*\(")


def check_folders(table, files):
    members = collections.defaultdict(list)
    for file in files:
        members[folder_of(file)].append(file)
    found = []
    for folder, inside in sorted(members.items()):
        if folder not in table.line_of:
            found.append(f"{inside[0]}:1: folder {folder} is missing in {TABLE}")
        if "internal" in folder.split("/"):
            found.append(f"{inside[0]}:1: folder {folder}: a header stands beside its source")
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
        for include in includes_of(root, file) if file != ALL_DOORS else ():
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


def check_commands(root, files):
    """Sources of apps beside the command line that know the option parser, or print."""
    found = []
    for file in files:
        if layer_of(file) != "apps" or COMMAND_LINE.fullmatch(file):
            continue
        if file not in PARSES:
            found += [f"{file}:{include.line}: only cmd_* may include {include.text}"
                      for include in includes_of(root, file) if include.text.startswith("CLI/")]
        if file in PRINTS:
            continue
        with open(os.path.join(root, file), encoding="utf-8", errors="replace") as source:
            lines = without_comments(source.read()).split("\n")
        found += [f"{file}:{number}: only cmd_* may print"
                  for number, line in enumerate(lines, 1) if PRINT.search(STRING.sub('""', line))]
    return found


def check(root):
    files = source_files(root)
    if not files:
        return [f"{root}: no sources"]
    table = read_table(root)
    found = [f"{TABLE}:{line}: {text}" for line, text in table.complaints]
    found += check_folders(table, files)
    violations, arrows = check_includes(root, table, files)
    found += violations
    found += check_commands(root, files)
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
