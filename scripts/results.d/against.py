"""Compares two sets of results, figure by figure: what `scripts/results --against` and `--compare` print.

against.py fetch BASELINE [SECTION...]    prints BASELINE as a single file, if it is well formed and has one of them
against.py compare OLD NEW [SECTION...]   OLD, NEW: folders of the form of docs/results, git revisions, or single
                                          files that fetch printed
  --names OLD NEW     what they are called in messages
  --all               prints figures that are the same to the digit, too
  --tolerances FILE   in place of tolerances.txt beside this program

Exit codes: 0 no figure is worse than its tolerance, 1 one is or is gone, 2 nothing could be compared.
"""

import argparse
import dataclasses
import pathlib
import subprocess
import sys

import rules as rules_module
import tables

HERE = pathlib.Path(__file__).resolve().parent


class Unusable(Exception):
    """No baseline, no section, no rules to compare by."""


@dataclasses.dataclass
class Line:
    section: str
    row: str
    column: str
    before: str
    after: str
    judgement: rules_module.Judgement
    tolerance: str = "-"


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


def gone(section, row, column="-", before="-"):
    return Line(section, row, column, before, "-", rules_module.Judgement("worse", "gone"))


def fresh(section, row):
    return Line(section, row, "-", "-", "-", rules_module.Judgement("new"))


def compare_cells(place, before, after, rules, references):
    """Lines of the figures of one cell; place is section, row and column."""
    old, old_text = tables.figures_of(before)
    new, new_text = tables.figures_of(after)
    if len(old) != len(new):
        # A figure that is lost altogether is told as such, whatever stood around it.
        if all(figure.kind == "missing" for figure in new) or not new:
            new = (new or [tables.Figure("missing", after)]) * len(old)
            new = new[: len(old)]
        elif all(figure.kind == "missing" for figure in old):
            return [Line(*place, before, after, rules_module.Judgement("new", "no figure before"))]
    if len(old) != len(new) or (not old and before.strip() != after.strip()):
        rule = rules.of(*place, 1)
        verdict = "info" if rule.direction == "info" else "worse"
        return [Line(*place, before, after, rules_module.Judgement(verdict, "of another form"), str(rule))]
    lines = []
    for part, (a, b) in enumerate(zip(old, new), 1):
        rule = rules.of(*place, part)
        name = place[2] if len(old) == 1 else f"{place[2]} #{part}"
        tolerance = "yes stays yes" if a.kind == "verdict" else str(rule)
        lines.append(Line(*place[:2], name, a.text, b.text, rules_module.judge(a, b, rule, references), tolerance))
    lost = any(figure.kind == "missing" for figure in old + new)
    if old and old_text != new_text and not lost and all(line.judgement.verdict == "same" for line in lines):
        rule = rules.of(*place, 1)
        verdict = "info" if rule.direction == "info" else "worse"
        lines.append(Line(*place, before, after, rules_module.Judgement(verdict, "of another form"), str(rule)))
    return lines


def compare_rows(place, old, new, rules, references):
    """Lines of one row: the cells of its figures by their columns; place is section and row, as they are now."""
    lines = []
    for column, before in old.items():
        name = column if column in new else rules.renamed_column(*place, column)
        if name is None:
            continue
        if name in new:
            lines += compare_cells((*place, name), before, new[name], rules, references)
        elif before not in ("", "-"):
            lines.append(gone(*place, column, before))
    return lines


def rows_without_names(missing, rest):
    """Pairs of rows whose names differ by numbers alone, where that is unambiguous."""
    def by_mask(names):
        result = {}
        for name in names:
            result.setdefault(tables.masked(name), []).append(name)
        return result

    old, new = by_mask(missing), by_mask(rest)
    return {a[0]: new[mask][0] for mask, a in old.items() if len(a) == 1 and len(new.get(mask, [])) == 1}


def compare_tables(section, old, new, rules, references):
    width = tables.key_width(old, new)
    old_rows, new_rows = tables.rows_by_key(old, width), tables.rows_by_key(new, width)
    names, missing = {}, []
    for row in old_rows:
        name = row if row in new_rows else rules.renamed_row(section, row)
        if name in new_rows:
            names[row] = name
        elif name is not None:
            missing.append(row)
    rest = [row for row in new_rows if row not in names.values()]
    lines = []
    for row, name in rows_without_names(missing, rest).items():
        names[row] = name
        lines += compare_cells((section, name, "(name)"), row, name, rules, references)
    for row, cells in old_rows.items():
        if row in names:
            figures = dict(zip(old.columns[width:], cells[width:]))
            others = dict(zip(new.columns[width:], new_rows[names[row]][width:]))
            lines += compare_rows((section, names[row]), figures, others, rules, references)
        elif row in missing:
            lines.append(gone(section, row))
    return lines + [fresh(section, row) for row in rest if row not in names.values()]


def compare_sections(old, new, rules):
    references = (old.reference_s, new.reference_s)
    if old.tables and not new.tables:
        return [gone(new.name, new.remark or "all of its tables")]
    lines = []
    for before, after in tables.matched_tables(old.tables, new.tables):
        if before is None:
            lines += [fresh(new.name, row) for row in tables.rows_by_key(after, tables.key_width(after))]
        elif after is None:
            width = tables.key_width(before)
            rows = tables.rows_by_key(before, width)
            lines += [gone(new.name, row) for row in rows if rules.renamed_row(new.name, row) is not None]
        else:
            lines += compare_tables(new.name, before, after, rules, references)
    return lines


def by_new_names(old, new, rules):
    """The older sections by the names they have now; new: names that are known to be there."""
    renamed = {name: name if name in new else rules.renamed_section(name) for name in old}
    return {new_name: old[name] for name, new_name in renamed.items() if new_name is not None}


def compare(old, new, rules, chosen, names=("the baseline", "the new results")):
    """Lines of all sections chosen (of all that the older has, where none is), by dictionaries of sections."""
    older = by_new_names(old, new, rules)
    wanted = list(chosen) or list(older)
    unknown = [name for name in wanted if name not in older and name not in new]
    if unknown:
        raise Unusable(f"neither {names[0]} nor {names[1]} has a section {unknown[0]}")
    if not any(name in older for name in wanted):
        raise Unusable(f"{names[0]} has no section {', '.join(wanted)}")
    lines = []
    for name in wanted:
        if name not in older:
            lines.append(fresh(name, "all of its rows"))
        elif name not in new:
            lines.append(gone(name, "all of its rows"))
        else:
            lines += compare_sections(older[name], new[name], rules)
    return lines


def print_lines(lines, everything, names, references):
    print(f"Figures of {names[0]} and of {names[1]}{references}:\n")
    print("| section | row | column | before | after | change | tolerance | verdict |")
    print("|---|---|---|---|---|---|---|---|")
    for line in lines:
        if everything or line.before != line.after or line.judgement.verdict not in ("same", "info"):
            verdict = line.judgement.verdict
            cells = (line.section, line.row, line.column, line.before, line.after, line.judgement.change or "-",
                     line.tolerance, f"**{verdict}**" if verdict == "worse" else verdict)
            print("|", " | ".join(cells), "|")
    count = {}
    for line in lines:
        key = "unchanged" if line.before == line.after and line.judgement.verdict in ("same", "info") else \
            {"same": "within tolerance", "info": "for information"}.get(line.judgement.verdict, line.judgement.verdict)
        count[key] = count.get(key, 0) + 1
    order = ("worse", "better", "within tolerance", "for information", "new", "unchanged")
    told = ", ".join(f"{count[key]} {key}" for key in order if key in count)
    print(f"\n{len(lines)} figures: {told or 'none'}.")


def told_references(old, new, chosen):
    pairs = [(old[n].reference_s, new[n].reference_s) for n in chosen or old if n in old and n in new]
    if not pairs or all(None in pair for pair in pairs):
        return " (no reference runs on both sides: times are as they were)"
    return ""


def read_rules(file):
    source = pathlib.Path(file)
    try:
        return rules_module.parse_rules(source.read_text(encoding="utf-8"), source.name)
    except OSError as error:
        raise Unusable(f"{source}: {error.strerror}") from None


def run_fetch(arguments):
    fetched = fetch(arguments.baseline)
    older = by_new_names(sections_of(fetched, arguments.baseline), arguments.sections, read_rules(arguments.tolerances))
    if arguments.sections and not any(name in older for name in arguments.sections):
        raise Unusable(f"{arguments.baseline} has no section {', '.join(arguments.sections)}")
    sys.stdout.write(single_file(fetched))
    return 0


def run_compare(arguments):
    names = arguments.names or (arguments.old, arguments.new)
    rules = read_rules(arguments.tolerances)
    old = sections_of(fetch(arguments.old), names[0])
    new = sections_of(fetch(arguments.new), names[1])
    lines = compare(old, new, rules, arguments.sections, names)
    print_lines(lines, arguments.all, names, told_references(old, new, arguments.sections))
    return 1 if any(line.judgement.verdict == "worse" for line in lines) else 0


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
    for command in (fetching, comparing):
        command.add_argument("--tolerances", default=HERE / "tolerances.txt")
    arguments = parser.parse_args(argv)
    try:
        if arguments.command == "fetch":
            return run_fetch(arguments)
        return run_compare(arguments)
    except (Unusable, tables.Malformed, rules_module.BadRule) as error:
        print(f"scripts/results: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
