"""Reads the #include lines of the project's sources, without comments."""
import os
import re
from typing import NamedTuple

LAYERS = ("graph", "frontend", "backend", "io", "eval", "pipeline", "apps")
ALL_DOORS = "pipeline/placegraph.h"  # it includes what it likes, for those who want everything
PROJECT = re.compile(r"(graph|frontend|backend|io|eval|pipeline|apps|tests|examples)/")
INCLUDE = re.compile(r'[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]')


class Include(NamedTuple):
    file: str    # relative to the root
    line: int    # counted from 1
    text: str    # as written between the brackets
    target: str  # relative to the root; empty for a header of another project


def folder_of(path):
    return os.path.dirname(path)


def layer_of(path):
    return path.split("/", 1)[0]


def source_files(root):
    """All .h and .cpp files of the layers, relative to the root, sorted."""
    found = []
    for layer in LAYERS:
        for folder, _, names in os.walk(os.path.join(root, layer)):
            found += [os.path.relpath(os.path.join(folder, name), root)
                      for name in names if name.endswith((".h", ".cpp"))]
    return sorted(found)


def without_comments(text):
    """The text with the same lines and without comments; string literals are kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?(?:\*/|\Z)'
                         r'|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)

    def blank(match):
        found = match.group(0)
        return "\n" * found.count("\n") if found.startswith("/") else found

    return pattern.sub(blank, text)


def target_of(text):
    """The path below the root that an include names, or an empty string."""
    if text.startswith("placegraph/"):
        return text[len("placegraph/"):]
    return text if PROJECT.match(text) else ""


def includes_of(root, file):
    with open(os.path.join(root, file), encoding="utf-8", errors="replace") as source:
        lines = without_comments(source.read()).split("\n")
    found = []
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if match:
            found.append(Include(file, number, match.group(1), target_of(match.group(1))))
    return found


def project_includes(root, files):
    """The includes that name a file of the project, in the order of the files."""
    return [include for file in files for include in includes_of(root, file) if include.target]
