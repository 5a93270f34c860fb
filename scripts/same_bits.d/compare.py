"""Every output file of one case, of the base program and of the present one."""
import os
from dataclasses import dataclass, field

import sqlite_rows
from compare_text import Finding, TextComparison


@dataclass
class Comparison:
    files: int = 0  # compared
    masked: int = 0  # values, in files that are not the same bytes
    differences: list = field(default_factory=list)  # a sentence for each file


def files_in(folder):
    """Relative paths."""
    found = []
    for root, _, names in os.walk(folder):
        for name in names:
            found.append(os.path.relpath(os.path.join(root, name), folder).replace(os.sep, "/"))
    return sorted(found)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def as_text(data):
    """Nothing for a binary file."""
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def compare_bytes(a, b):
    if a == b:
        return Finding()
    at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    sizes = f"; {len(a)} and {len(b)} bytes" if len(a) != len(b) else ""
    return Finding(f"byte {at}: base {a[at: at + 8].hex(' ') or 'ends'}, present {b[at: at + 8].hex(' ') or 'ends'}{sizes}")


def compare_files(name, base_path, present_path, texts):
    """`texts` is the TextComparison of the case."""
    a, b = read(base_path), read(present_path)
    has_log = os.path.exists(base_path + "-wal") or os.path.exists(present_path + "-wal")
    if a == b and not has_log:
        return Finding()
    if a[:16] == b[:16] == sqlite_rows.MAGIC:
        same_text = lambda x, y: not texts.compare("cell.yaml", x, y).difference
        return Finding(sqlite_rows.compare_databases(base_path, present_path, texts.renames, same_text, texts.masks.keys) or "")
    text_a, text_b = as_text(a), as_text(b)
    if text_a is None or text_b is None:
        return compare_bytes(a, b)
    return texts.compare(name, text_a, text_b)


def nothing_printed(path, masks):
    """Nothing but lines that are not compared."""
    text = as_text(read(path))
    return text is not None and all(not line or masks.drops_line(line) for line in text.split("\n"))


def compare_folders(base, present, masks, renames, folders=(), ignore=()):
    """`masks` are those of the case; `folders` are paths to be masked; `ignore` are paths that are no outputs."""
    texts = TextComparison(masks, renames, folders)
    result = Comparison()
    ignored = lambda path: any(path == i or path.startswith(i + "/") for i in ignore)
    of_base = {renames.present_path(path): path for path in files_in(base) if not ignored(path)}
    of_present = {path for path in files_in(present) if not any(
        path == renames.present_path(i) or path.startswith(renames.present_path(i) + "/") for i in ignore)}
    for path in sorted(set(of_base) | of_present):
        if path not in of_base or path not in of_present:
            result.differences.append(f"{path}: only in {'base' if path in of_base else 'present'}")
            continue
        if path.endswith((".db-wal", ".db-shm")):
            continue  # the log of a database is compared with the database
        base_path, present_path = os.path.join(base, of_base[path]), os.path.join(present, path)
        if path.startswith(("stdout_", "stderr_")) and nothing_printed(base_path, masks) and nothing_printed(present_path, masks):
            continue
        finding = compare_files(path, base_path, present_path, texts)
        result.files += 1
        result.masked += finding.masked
        if finding.difference:
            result.differences.append(f"{path}: {finding.difference}")
    return result
