"""Reads the pages of docs/results: sections, tables, rows, and the figures of a cell.

A section is a page of docs/results, named by its file, or a part of a single file between lines
`<!-- section: NAME -->`, the form in which a run keeps its baseline.
"""

import dataclasses
import math
import re


class Malformed(Exception):
    """A file that is not of the form of the pages of docs/results."""


@dataclasses.dataclass
class Table:
    heading: str
    names: list  # of the columns, as they stand
    rows: list  # lists of cells, as many as columns
    line: int

    @property
    def columns(self):
        """The names, made unique."""
        return unique_columns(self.names)


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


def pattern(text):
    """`*` stands for anything, all else for itself."""
    return re.compile(".*".join(re.escape(part) for part in text.strip().split("*")), re.DOTALL)


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
    table = Table(heading, columns, [], start + 1)
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


def read_section(name, lines, first, last, source):
    """The section in lines[first:last]."""
    section, heading, at = Section(name, []), "", first
    while at < last:
        line = lines[at]
        if re.match("#{1,3} ", line):
            heading = line.lstrip("#").strip()
        elif line.lstrip().startswith("|"):
            table, at = read_table(lines, at, heading, source)
            section.tables.append(table)
            continue
        elif told := re.match(r"(?:Measured at .*; r|R)eference run (\d+\.?\d*) s\b", line):
            section.reference_s = float(told[1])
        elif line.startswith(("Absent:", "**no**: failed")):
            section.remark = line.strip()
        at += 1
    return section


def parse(text, source):
    """The sections of a single file by their names."""
    lines = text.splitlines()
    marks = [(at, mark[1]) for at, line in enumerate(lines)
             if (mark := re.fullmatch(r"<!-- section: (\S+) -->\s*", line))]
    if not marks:
        raise Malformed(f"{source}: no section of results in it")
    sections = {}
    for (at, name), (end, _) in zip(marks, marks[1:] + [(len(lines), "")]):
        if name in sections:
            raise Malformed(f"{source}:{at + 1}: a second section {name}")
        sections[name] = read_section(name, lines, at + 1, end, source)
    return sections


def parse_page(name, text, source):
    """The section of a page of its own."""
    lines = text.splitlines()
    if not lines or not lines[0].startswith("# "):
        raise Malformed(f"{source}:1: a page of results begins with '# HEADING'")
    return read_section(name, lines, 0, len(lines), source)


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


def key_of_continuation(table, after):
    """How many columns the table `after` repeats, so that its others go on with the rows of `table`; 0 where
    it is a table of its own: of another heading, other rows, or with a column that `table` has too."""
    if table.heading != after.heading or len(table.rows) != len(after.rows):
        return 0
    width = 0
    for name, other in zip(table.names, after.names):
        if name != other or any(a[width] != b[width] for a, b in zip(table.rows, after.rows)):
            break
        width += 1
    keys = {tuple(row[:width]) for row in table.rows}
    rest = [name for name in after.names[width:] if name.lower() not in GENERIC]
    if width == 0 or not rest or len(keys) != len(table.rows) or set(rest) & set(table.names):
        return 0
    return width


def joined_tables(tables):
    """The tables, a wide one that is written as several with the same first columns as one."""
    result = []
    for table in tables:
        width = key_of_continuation(result[-1], table) if result else 0
        if width:
            wide = result.pop()
            table = Table(wide.heading, wide.names + table.names[width:],
                          [a + b[width:] for a, b in zip(wide.rows, table.rows)], wide.line)
        result.append(table)
    return result
