"""Compares two sets of results by `placegraph eval gate`: what `scripts/results --against` and `--compare` print.

against.py fetch BASELINE [SECTION...]    prints BASELINE as a single file, if it is well formed and has one of them
against.py compare OLD NEW [SECTION...]   OLD, NEW: folders of the form of docs/results, git revisions, or single
                                          files that fetch printed
  --names OLD NEW     what they are called in messages
  --all               prints figures that are the same to the digit, too
  --tolerances FILE   in place of tolerances.txt beside this program
  --program FILE      the gate, in place of build/release/placegraph or $PLACEGRAPH

Exit codes: 0 no figure is worse than its tolerance, 1 one is or is gone, 2 nothing could be compared.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import tables

HERE = pathlib.Path(__file__).resolve().parent


class Unusable(Exception):
    """No baseline, no section, no program to compare by."""


def pages_of_folder(folder):
    """{path: text} of the pages in a folder of results."""
    paths = sorted(path for path in folder.glob("*.md") if path.is_file())
    if not paths:
        raise Unusable(f"{folder}: no page of results in it")
    return {str(path): path.read_text(encoding="utf-8") for path in paths}


def git(*arguments):
    """What git prints of this repository; None where it fails."""
    try:
        done = subprocess.run(["git", *arguments], cwd=HERE, capture_output=True, check=False)
    except OSError as error:
        raise Unusable(f"git cannot be run: {error}") from None
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else None


def of_revision(name):
    """The pages of docs/results of a git revision."""
    listed = git("ls-tree", "--full-tree", "--name-only", name, "docs/results/")
    paths = [path for path in (listed or "").splitlines() if path.endswith(".md")]
    if not paths:
        raise Unusable(f"'{name}' is neither a file or folder of results nor a git revision with docs/results")
    return {f"{name}:{path}": git("show", f"{name}:{path}") for path in paths}


def fetch(name):
    """What a name stands for: the text of a single file, or {path: text} of pages."""
    path = pathlib.Path(name)
    if not name or name.startswith("-"):
        raise Unusable(f"'{name}' is neither a file or folder of results nor a git revision")
    try:
        if path.is_dir():
            return pages_of_folder(path)
        if path.is_file():
            return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise Unusable(f"{name}: cannot be read: {error}") from None
    return of_revision(name)


def section_of_page(path):
    return pathlib.PurePath(path).stem


def sections_of(fetched, name):
    """The sections of what `fetch` has read; a single file is called `name` in messages."""
    if isinstance(fetched, str):
        return tables.parse(fetched, name)
    return {section_of_page(path): tables.parse_page(section_of_page(path), text, path)
            for path, text in fetched.items()}


def single_file(fetched):
    """The text of a single file with the same sections."""
    if isinstance(fetched, str):
        return fetched
    return "\n".join(f"<!-- section: {section_of_page(path)} -->\n\n{text}" for path, text in fetched.items())


def figures_of_cell(column, cell):
    """The figures of a cell as a record has them; a cell without numbers is one that has a text alone."""
    found, form = tables.figures_of(cell)
    if not found:
        return [{"key": column, "better": "equal", "values": [None], "text": form}]
    recorded = []
    for part, figure in enumerate(found):
        places = iter("{}" if k == part else "#" for k in range(len(found)))
        text = "".join(next(places) if c == "\0" else c for c in form)
        value = bool(figure.value) if figure.kind == "verdict" else figure.value
        one = {"key": column if len(found) == 1 else f"{column}#{part + 1}", "better": "equal",
               "values": [value if math.isfinite(value) else None]}
        one |= {"whole": figure.total} if figure.kind == "fraction" else {}
        recorded.append(one | ({"text": text} if text != "{}" else {}))
    return recorded


def columns_of(table):
    """The columns; a target, a verdict and a peer are named by the column that they are of, too."""
    names, subject = [], ""
    for name in table.names:
        if name.lower() in tables.GENERIC:
            name = f"{name} ({subject})" if subject else name
        else:
            subject = name
        names.append(name if name not in names else f"{name} no. {names.count(name) + 1}")
    return names


def widths_of(*versions):
    """Columns that name the rows of a table, so many that they do in each version of a section."""
    same = {}
    for section in versions:
        for table in tables.joined_tables(section.tables):
            same.setdefault((table.heading, table.names[0]), []).append(table)
    return {place: tables.key_width(*alike) for place, alike in same.items()}


def sequences_of(section, widths):
    """A section as a record has it: each row is a sequence. Rows of one name in several tables are one."""
    rows = {}
    for table in tables.joined_tables(section.tables):
        width = widths[table.heading, table.names[0]]
        for name, cells in tables.rows_by_key(table, width).items():
            figures = [figure for column, cell in list(zip(columns_of(table), cells))[width:]
                       for figure in figures_of_cell(column, cell)]
            keys, copy, wanted = {figure["key"] for figure in figures}, 1, name
            while any(figure["key"] in keys for figure in rows.get(wanted, [])):
                copy += 1
                wanted = f"{name} no. {copy}"
            rows.setdefault(wanted, []).extend(figures)
    reference = {"reference_s": section.reference_s} if section.reference_s else {}
    return [{"name": f"{section.name}/{name}", **reference, "figures": figures} for name, figures in rows.items()]


def chosen_sections(old, new, chosen, names):
    """The sections to compare: those chosen, or all that the older has."""
    wanted = list(chosen) or list(old)
    unknown = [name for name in wanted if name not in old and name not in new]
    if unknown:
        raise Unusable(f"neither {names[0]} nor {names[1]} has a section {unknown[0]}")
    if not any(name in old for name in wanted):
        raise Unusable(f"{names[0]} has no section {', '.join(wanted)}")
    return wanted


def write_records(old, new, wanted, names, files):
    """Both versions of the sections as records."""
    sequences = ([], [])
    for name in wanted:
        versions = [(kept, version[name]) for kept, version in zip(sequences, (old, new)) if name in version]
        widths = widths_of(*(section for _, section in versions))
        for kept, section in versions:
            kept.extend(sequences_of(section, widths))
    for name, kept, file in zip(names, sequences, files):
        record = {"format": "placegraph record", "version": 1, "programs": [name], "sequences": kept}
        file.write_text(json.dumps(record, allow_nan=False), encoding="utf-8")


def gate_program(named):
    """The program that compares."""
    built = HERE.parents[1] / "build" / "release" / "placegraph"
    program = pathlib.Path(named or (built if built.is_file() else os.environ.get("PLACEGRAPH", built)))
    if not program.is_file():
        raise Unusable(f"{program} is not built; `cmake --build --preset release --target placegraph_cli` builds it")
    return program.resolve()


def run_fetch(arguments):
    fetched = fetch(arguments.baseline)
    sections = sections_of(fetched, arguments.baseline)
    if arguments.sections and not any(name in sections for name in arguments.sections):
        raise Unusable(f"{arguments.baseline} has no section {', '.join(arguments.sections)}")
    sys.stdout.write(single_file(fetched))
    return 0


def run_compare(arguments):
    names = arguments.names or (arguments.old, arguments.new)
    old = sections_of(fetch(arguments.old), names[0])
    new = sections_of(fetch(arguments.new), names[1])
    wanted = chosen_sections(old, new, arguments.sections, names)
    command = [gate_program(arguments.program), "eval", "gate", "before.json", "after.json",
               "--rules", pathlib.Path(arguments.tolerances).resolve()]
    with tempfile.TemporaryDirectory() as folder:
        write_records(old, new, wanted, names, [pathlib.Path(folder, file) for file in command[3:5]])
        done = subprocess.run(command + ([] if arguments.all else ["--changed"]), cwd=folder, capture_output=True,
                              text=True, check=False)
    sys.stdout.write(done.stdout)
    if done.returncode not in (0, 1):
        raise Unusable(done.stderr.strip().removeprefix("placegraph: "))
    return done.returncode


def main(argv):
    parser = argparse.ArgumentParser(prog="scripts/results", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    fetching = commands.add_parser("fetch")
    fetching.add_argument("baseline")
    fetching.add_argument("sections", nargs="*")
    comparing = commands.add_parser("compare")
    comparing.add_argument("old")
    comparing.add_argument("new")
    comparing.add_argument("sections", nargs="*")
    comparing.add_argument("--names", nargs=2)
    comparing.add_argument("--all", action="store_true")
    comparing.add_argument("--tolerances", default=HERE / "tolerances.txt")
    comparing.add_argument("--program")
    arguments = parser.parse_args(argv)
    try:
        return run_fetch(arguments) if arguments.command == "fetch" else run_compare(arguments)
    except (Unusable, tables.Malformed, OSError) as error:
        print(f"scripts/results: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
