"""Two SQLite files, table by table and row by row."""
import contextlib
import os
import shutil
import sqlite3
import struct
import tempfile

MAGIC = b"SQLite format 3\0"
PRAGMAS = ("application_id", "user_version", "page_size")


@contextlib.contextmanager
def opened(path):
    """A copy is opened, with its log: reading must leave the folder of the outputs as it is."""
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "copy.db")
        shutil.copyfile(path, copy)
        if os.path.exists(path + "-wal"):
            shutil.copyfile(path + "-wal", copy + "-wal")
        connection = sqlite3.connect(copy)
        connection.text_factory = lambda data: data.decode("utf-8", "surrogateescape")
        try:
            yield connection
        finally:
            connection.close()


def quoted(name):
    return '"' + name.replace('"', '""') + '"'


def tables_of(connection):
    rows = connection.execute("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%' ORDER BY name")
    return [row[0] for row in rows]


def columns_of(connection, table):
    """(name, declared type, place in the primary key), in their order."""
    return [(row[1], row[2], row[5]) for row in connection.execute(f"PRAGMA table_info({quoted(table)})")]


def rows_of(connection, table, columns):
    key = [name for name, _, place in sorted(columns, key=lambda c: c[2]) if place]
    order = ", ".join(map(quoted, key)) if key else "rowid"
    names = ", ".join(quoted(name) for name, _, _ in columns)
    return connection.execute(f"SELECT {names} FROM {quoted(table)} ORDER BY {order}"), key or ["rowid"]


def bits(value):
    return struct.pack("<d", value) if isinstance(value, float) else value


def excerpt(value, at=0):
    if isinstance(value, bytes):
        return f"{len(value)} bytes, byte {at}: {value[at: at + 8].hex(' ')}"
    text = repr(value)
    return text if len(text) <= 80 else repr(str(value)[max(0, at - 20): at + 50])


def first_unequal(a, b):
    return next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))


def different_cell(a, b, same_text):
    """A sentence on two cells that differ, or nothing."""
    if type(a) is type(b) and bits(a) == bits(b):
        return None
    if isinstance(a, str) and isinstance(b, str) and same_text(a, b):
        return None
    at = first_unequal(a, b) if type(a) is type(b) and isinstance(a, (bytes, str)) else 0
    return f"base {excerpt(a, at)}, present {excerpt(b, at)}"


def compare_table(base, present, old, new, renames, same_text, masked):
    columns, present_columns = columns_of(base, old), columns_of(present, new)
    expected = [(renames.columns.get(f"{old}.{name}", name), kind, key) for name, kind, key in columns]
    if expected != present_columns:
        return f"table {new}: columns differ: base {columns}, present {present_columns}"
    base_rows, key = rows_of(base, old, columns)
    present_rows, _ = rows_of(present, new, present_columns)
    names = [name for name, _, _ in present_columns]
    # The checksum of a row with a masked value is masked, too.
    unseen = masked | {"checksum"} if masked & set(names) else set()
    place_of_key = [[name for name, _, _ in columns].index(k) for k in key if k != "rowid"]
    number = 0
    while True:
        a, b = base_rows.fetchone(), present_rows.fetchone()
        number += 1
        if a is None and b is None:
            return None
        row = a if a is not None else b
        where = ", ".join(f"{names[i]} {row[i]}" for i in place_of_key) or f"row {number}"
        if a is None or b is None:
            return f"table {new}, {where}: only in {'present' if a is None else 'base'}"
        for i, name in enumerate(names):
            if name in unseen:
                continue
            found = different_cell(a[i], b[i], same_text)
            if found:
                return f"table {new}, {where}, column {name}: {found}"


def compare_databases(base_path, present_path, renames, same_text=lambda a, b: False, masked=frozenset()):
    """A sentence on the first difference, or nothing. `same_text` judges texts of cells that are not the same bits;
    columns with the names in `masked` are not compared."""
    try:
        with opened(base_path) as base, opened(present_path) as present:
            for pragma in PRAGMAS:
                a, b = (c.execute(f"PRAGMA {pragma}").fetchone()[0] for c in (base, present))
                if a != b:
                    return f"{pragma}: base {a}, present {b}"
            pairs = {renames.tables.get(name, name): name for name in tables_of(base)}
            for name in sorted(set(pairs) ^ set(tables_of(present))):
                return f"table {name}: only in {'base' if name in pairs else 'present'}"
            for new in sorted(pairs):
                found = compare_table(base, present, pairs[new], new, renames, same_text, masked)
                if found:
                    return found
            return None
    except sqlite3.Error as error:
        return f"cannot be read as SQLite: {error}"
