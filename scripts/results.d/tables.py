"""Reads the tables of a file as docs/results.md is: sections, tables, rows, and the figures of a cell."""

import dataclasses
import math
import re


class Malformed(Exception):
    """A file that is not of the form of docs/results.md."""


@dataclasses.dataclass
class Table:
    heading: str
    columns: list  # names, made unique
    rows: list  # lists of cells, as many as columns
    line: int


@dataclasses.dataclass
class Section:
    name: str
    tables: list
    reference_s: float | None = None  # the reference run of the same sitting
    remark: str = ""  # "Absent ...", "failed ..." of a section without tables


@dataclasses.dataclass(frozen=True)
class Figure:
    """One figure of a cell. Kinds: number, fraction (value of total), verdict (1 yes, 0 no), missing."""

    kind: str
    text: str
    value: float = math.nan
    total: float = math.nan


GENERIC = ("target", "met", "target met", "best peer")
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
FIGURE = re.compile(
    rf"(?P<verdict>\*\*no\*\*|\byes\b)"
    rf"|(?P<missing>\b(?:none|null|no answer|absent)\b)"
    rf"|(?<![\w.@])(?P<nan>[-+]?(?:nan|inf)\b)"
    rf"|(?<![\w./])(?P<value>\d+)(?: of |/)(?P<total>\d+)(?![\w./])"
    rf"|(?<![\w.@])(?P<number>{NUMBER})(?!\w)",
    re.IGNORECASE,
)


def figures_of(cell):
    """(figures, text between them) of a cell."""
    cell = cell.strip()
    if cell in ("", "-"):
        return [Figure("missing", cell or "-")], "\0"
    found = []
    for match in FIGURE.finditer(cell):
        text, kind = match.group(0), match.lastgroup
        if kind == "verdict":
            found.append(Figure("verdict", text, 1.0 if text.lower() == "yes" else 0.0))
        elif kind == "missing":
            found.append(Figure("missing", text))
        elif kind == "total":
            found.append(Figure("fraction", text, float(match["value"]), float(match["total"])))
        else:
            found.append(Figure("number", text, float(text)))
    return found, re.sub(r"\s+", " ", FIGURE.sub("\0", cell))


def masked(text):
    """A name without the numbers in it."""
    return re.sub(rf"(?<![\w.@]){NUMBER}(?!\w)", "#", text)


def cells_of(line):
    stripped = line.strip()
    if len(stripped) < 2 or not stripped.endswith("|"):
        raise ValueError
    return [cell.strip() for cell in stripped[1:-1].split("|")]


def unique_columns(names):
    """Repeated names are told apart by the column before them that is neither target nor verdict."""
    result, subject = [], ""
    for name in names:
        if name.lower() not in GENERIC:
            subject = name
        full = f"{name} ({subject})" if names.count(name) > 1 and subject != name else name
        copies = sum(1 for other in result if other == full or other.startswith(full + " no. "))
        result.append(full if copies == 0 else f"{full} no. {copies + 1}")
    return result


def read_table(lines, start, heading, source):
    """The table whose head is lines[start], and the line behind it."""
    try:
        columns = cells_of(lines[start])
    except ValueError:
        raise Malformed(f"{source}:{start + 1}: a line of a table that does not end with '|'") from None
    if start + 1 >= len(lines) or not re.fullmatch(r"\s*\|(\s*:?-+:?\s*\|)+\s*", lines[start + 1]):
        raise Malformed(f"{source}:{start + 1}: a table without a line of dashes below its head")
    table = Table(heading, unique_columns(columns), [], start + 1)
    at = start + 2
    while at < len(lines) and lines[at].lstrip().startswith("|"):
        try:
            row = cells_of(lines[at])
        except ValueError:
            raise Malformed(f"{source}:{at + 1}: a line of a table that does not end with '|'") from None
        if len(row) != len(columns):
            raise Malformed(f"{source}:{at + 1}: {len(row)} cells where the head has {len(columns)}")
        table.rows.append(row)
        at += 1
    return table, at


def parse(text, source):
    """The sections of a results file by their names."""
    sections, section, heading, at = {}, None, "", 0
    lines = text.splitlines()
    while at < len(lines):
        line = lines[at]
        mark = re.fullmatch(r"<!-- section: (\S+) -->\s*", line)
        if mark:
            if mark[1] in sections:
                raise Malformed(f"{source}:{at + 1}: a second section {mark[1]}")
            section, heading = Section(mark[1], []), ""
            sections[mark[1]] = section
        elif section is None:
            pass
        elif line.startswith("### "):
            heading = line[4:].strip()
        elif line.lstrip().startswith("|"):
            table, at = read_table(lines, at, heading, source)
            section.tables.append(table)
            continue
        elif line.startswith("Measured at "):
            told = re.search(r"; reference run (\d+\.?\d*) s\b", line)
            section.reference_s = float(told[1]) if told else None
        elif line.startswith(("Absent:", "**no**: failed")):
            section.remark = line.strip()
        at += 1
    if not sections:
        raise Malformed(f"{source}: no section of results in it")
    return sections


def key_width(*tables):
    """The first so many columns name a row: as few as tell the rows of each table apart."""
    most = min(len(table.columns) for table in tables)
    for width in range(1, most):
        keys = [[tuple(row[:width]) for row in table.rows] for table in tables]
        if all(len(set(k)) == len(k) for k in keys):
            return width
    return 1


def rows_by_key(table, width):
    """{name: cells}; the second of two rows of one name has "no. 2" behind it."""
    rows = {}
    for row in table.rows:
        name = ", ".join(cell for cell in row[:width] if cell not in ("", "-"))
        key, copy = name, 1
        while key in rows:
            copy += 1
            key = f"{name} no. {copy}"
        rows[key] = row
    return rows


def matched_tables(before, after):
    """Pairs of tables of two versions of a section: by heading, first column and order, then by first
    column and order alone; None where the other version has none."""

    def keyed(tables):
        counts, result = {}, {}
        for table in tables:
            key = (table.heading, table.columns[0])
            counts[key] = counts.get(key, 0) + 1
            result[(*key, counts[key])] = table
        return result

    old, new = keyed(before), keyed(after)
    pairs = [(old[key], new[key]) for key in old if key in new]
    rest = [table for key, table in new.items() if key not in old]
    for key in (key for key in old if key not in new):
        other = next((table for table in rest if table.columns[0] == key[1]), None)
        if other is not None:
            rest.remove(other)
        pairs.append((old[key], other))
    return pairs + [(None, table) for table in rest]
