"""Writes docs/results.md, the summary of the pages of docs/results, by the rows of summary.txt beside this program.

summary.py ROOT            writes ROOT/docs/results.md
summary.py ROOT --check    writes nothing; exits with 1 where the file is another

Every figure is read from the pages, so that the summary cannot disagree with them. Exit codes: 0 it is
as the pages say, 1 it is not (--check), 2 a row of summary.txt cannot be read, its figure is not in the
pages or is there twice, or there are more than 60 rows.
"""

import argparse
import dataclasses
import pathlib
import re
import sys

import tables

HERE = pathlib.Path(__file__).resolve().parent
MOST_ROWS = 60
COLUMNS = ("figure", "measured", "target", "met", "best other system", "page")
HEAD = """# Results

What the system reaches, beside the best other system where one was measured on the same data. Every
row is a figure of a page in [results](results/), which has the command that measures it.
`scripts/results` writes the pages, and this summary from them by `scripts/results.d/summary.txt`,
which also names the source of each figure of another system. **no** is a target that is missed;
"beside our" gives the figure that we had in the same sitting.
"""
FOOT = """## How to read the pages

`$DATA` is the folder of research data (`PLACEGRAPH_DATA` or `../shared/data`), which is not part of
the project. Figures of trajectories are those of [evaluation](evaluation.md): `origin` fits
nothing, so such figures are metric. They are those of optimized trajectories unless a page says
otherwise. Figures of pose graphs are explained in [optimize](optimize.md).

Times differ between machines by a factor of two and more. The foot of each page names its machine
and the CPU time of a fixed reference run (`scripts/results.d/reference_run.cpp`), the median of
runs before and after the section: times of two sittings compare by their ratios to it. Sections
measured before it existed name the machine alone. `scripts/results --against BASELINE` compares
every figure of a table with an older revision, within the tolerances of
`scripts/results.d/tolerances.txt`.
"""


class Unusable(Exception):
    """A row of the summary that cannot be written."""


@dataclasses.dataclass
class Row:
    figure: str
    page: str
    heading: str  # of the table, with *; empty: any
    row: str  # with *
    function: str  # max, min, sum, met; empty: the only row
    column: str
    part: int | None  # the figure of the cell; None: the whole cell
    target: str  # "-", a column, "COLUMN; COLUMN OF THE VERDICT", or a text in quotes
    peer: str
    where: str


def read_rows(text, source):
    """Groups (title, rows) of the lines that summary.txt explains."""
    groups = []
    for number, line in enumerate(text.splitlines(), 1):
        line, where = line.strip(), f"{source}:{number}"
        if line.startswith("## "):
            groups.append((line[3:], []))
        elif line and not line.startswith("#"):
            fields = [field.strip() for field in line.split(" | ")]
            if len(fields) != 7 or not all(fields) or not groups:
                raise Unusable(f"{where}: a line below '## GROUP' is 'FIGURE | PAGE | ROW | COLUMN | TARGET | PEER | SOURCE'")
            if (fields[5] == "-") != (fields[6] == "-"):
                raise Unusable(f"{where}: a figure of another system has a source, and no other does")
            page, _, heading = fields[1].partition(": ")
            told = re.fullmatch(r"(?:(max|min|sum|met): )?(.*?)(?:#(\d+))?", fields[3])
            groups[-1][1].append(Row(fields[0], page, heading, fields[2], told[1] or "", told[2],
                                     int(told[3]) if told[3] else None, fields[4], fields[5], where))
    return groups


def matching_rows(section, row):
    """[{column: cell}] of the rows of the one table that fit."""
    found = []
    for table in tables.joined_tables(section.tables):
        if row.column not in table.columns or (row.heading and not tables.pattern(row.heading).fullmatch(table.heading)):
            continue
        keyed = tables.rows_by_key(table, tables.key_width(table))
        fits = [dict(zip(table.columns, cells)) for name, cells in keyed.items() if tables.pattern(row.row).fullmatch(name)]
        if fits:
            found.append(fits)
    if len(found) != 1:
        raise Unusable(f"{row.where}: '{row.row} | {row.column}' is in {len(found)} tables of {row.page}")
    if not row.function and len(found[0]) != 1:
        raise Unusable(f"{row.where}: '{row.row}' fits {len(found[0])} rows of {row.page}")
    return found[0]


def verdict_counts(cells):
    verdicts = [figure.value for cell in cells for figure in tables.figures_of(cell)[0] if figure.kind == "verdict"]
    return int(sum(verdicts)), len(verdicts)


def measured_of(row, cells):
    """The text of the figure, and its value."""
    if row.function == "met":
        met, total = verdict_counts(cells)
        if total == 0:
            raise Unusable(f"{row.where}: no verdict in '{row.column}'")
        return f"{met} of {total}", met - total
    picked = []
    for cell in cells:
        figures = [figure for figure in tables.figures_of(cell)[0] if figure.kind in ("number", "fraction", "verdict")]
        if not figures or (row.part or 1) > len(figures):
            raise Unusable(f"{row.where}: no figure in '{row.column}': '{cell}'")
        picked.append((figures[(row.part or 1) - 1], cell))
    if row.function == "sum":
        total = sum(figure.value for figure, _ in picked)
        return f"{total:g}", total
    choose = {"max": max, "min": min, "": lambda found, key: found[0]}[row.function]
    figure, cell = choose(picked, key=lambda pair: pair[0].value)
    return (cell if row.part is None and not row.function else figure.text), figure.value


def judged(text, value, where):
    """Whether a value meets a text such as "<= 5"."""
    told = re.fullmatch(r"(<=|>=|=)? ?([-+.\deE]+)", text)
    if not told:
        raise Unusable(f"{where}: '{text}' is no limit; one is \"<= 5\"")
    limit = float(told[2])
    return {"<=": value <= limit, ">=": value >= limit}.get(told[1], value == limit)


def target_of(row, found, value):
    """The target and whether it is met."""
    if row.target == "-":
        return "-", "-"
    if row.target.startswith('"'):
        text = row.target.strip('"')
        met = value == 0 if text == "all" else judged(text, value, row.where)
        return text, "yes" if met else "**no**"
    column, _, verdict = row.target.partition("; ")
    verdict = verdict or column.replace("target", "met")
    for name in (column, verdict):
        if name not in found[0]:
            raise Unusable(f"{row.where}: {row.page} has no column '{name}' there")
    met, total = verdict_counts(cells[verdict] for cells in found)
    if total == 0:
        raise Unusable(f"{row.where}: no verdict in '{verdict}'")
    text = column if column == verdict else found[0][column]
    return text, "yes" if met == total else "**no**"


def line_of(row, sections):
    if row.page not in sections:
        raise Unusable(f"{row.where}: there is no page {row.page}")
    found = matching_rows(sections[row.page], row)
    text, value = measured_of(row, [cells[row.column] for cells in found])
    target, met = target_of(row, found, value)
    return f"| {row.figure} | {text} | {target} | {met} | {row.peer} | [{row.page}] |"


def counts_of(section):
    """Verdicts of a page: how many targets are met, and how many there are."""
    cells = [cell for table in section.tables for cells in table.rows
             for name, cell in zip(table.names, cells) if name.lower() not in ("target", "measured")]
    return verdict_counts(cells)


def wrapped(words, separator=", "):
    """Words in lines of 100 characters at most."""
    lines, line = [], ""
    for number, word in enumerate(words):
        piece = word + (separator.rstrip() if number + 1 < len(words) else ".")
        if line and len(line) + 1 + len(piece) > 100:
            lines.append(line)
            line = piece
        else:
            line = f"{line} {piece}".strip()
    return "\n".join(lines + [line])


def summary(sections, groups):
    rows = sum(len(rows) for _, rows in groups)
    if rows > MOST_ROWS:
        raise Unusable(f"summary.txt: {rows} rows, {MOST_ROWS} are allowed")
    parts = [HEAD]
    for title, group in groups:
        lines = [f"## {title}", "", f"| {' | '.join(COLUMNS)} |", "|" + "---|" * len(COLUMNS)]
        parts.append("\n".join(lines + [line_of(row, sections) for row in group]) + "\n")
    counts = {name: counts_of(section) for name, section in sections.items()}
    met, total = (sum(count[k] for count in counts.values()) for k in (0, 1))
    missed = [f"[{name}] {count[1] - count[0]}" for name, count in counts.items() if count[0] < count[1]]
    parts.append(f"## Targets\n\nAll pages together have {total} targets: {met} are met, {total - met} are missed. "
                 f"Missed by page:\n{wrapped(missed or ['none'])}\n")
    parts.append(FOOT)
    parts.append("## All pages\n\n" + wrapped([f"[{name}]" for name in sections]) + "\n")
    return "\n".join(parts) + "\n" + "".join(f"[{name}]: results/{name}.md\n" for name in sections)


def read_sections(folder):
    paths = sorted(folder.glob("*.md"))
    if not paths:
        raise Unusable(f"{folder}: no page of results in it")
    return {path.stem: tables.parse_page(path.stem, path.read_text(encoding="utf-8"), str(path)) for path in paths}


def main(argv):
    parser = argparse.ArgumentParser(prog="scripts/results --summary", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--rows", type=pathlib.Path, default=HERE / "summary.txt")
    arguments = parser.parse_args(argv)
    file = arguments.root / "docs" / "results.md"
    try:
        groups = read_rows(arguments.rows.read_text(encoding="utf-8"), arguments.rows.name)
        text = summary(read_sections(arguments.root / "docs" / "results"), groups)
    except (Unusable, tables.Malformed, OSError) as error:
        print(f"scripts/results: {error}", file=sys.stderr)
        return 2
    rows = sum(len(group) for _, group in groups)
    if not arguments.check:
        file.write_text(text, encoding="utf-8")
        return 0
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        print("docs/results.md is not what its pages say; scripts/results --summary writes it")
        return 1
    print(f"summary: {rows} rows, all as their pages say")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
