"""sizes.py ROOT: no source over 400 lines, no class declaration over 150, no function over 60, no slice of a class.

A slice of a class is a source that defines member functions of a class which is declared elsewhere
in a header of another name: "line_cue_views.cpp" with functions of LineCue. A source may define
members of every class that it, or the header of its own name, declares.
"""
import os
import re
import sys

from cpp_scopes import scopes_of
from source_includes import source_files

FILE_LINES, CLASS_LINES, FUNCTION_LINES = 400, 150, 60


def read_scopes(root, file):
    path = os.path.join(root, file)
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as source:
        return scopes_of(source.read())


def faults_of(root, file):
    try:
        scopes = read_scopes(root, file)
    except ValueError as error:
        return [f"{file}:{error}"]
    with open(os.path.join(root, file), encoding="utf-8") as source:
        lines = source.read().count("\n")
    found = [f"{file}: {lines} lines, {FILE_LINES} are allowed"] if lines > FILE_LINES else []
    own = {scope.name for scope in scopes if scope.kind == "class"}
    if file.endswith(".cpp"):
        header = re.sub(r"\.cpp$", ".h", file)
        own |= {scope.name for scope in read_scopes(root, header) if scope.kind == "class"}
    foreign = {}
    for scope in scopes:
        limit = CLASS_LINES if scope.kind == "class" else FUNCTION_LINES
        if scope.lines > limit:
            found.append(f"{file}:{scope.first}: {scope.kind} {scope.name} has {scope.lines} lines, "
                         f"{limit} are allowed")
        if scope.owner and scope.owner not in own:
            foreign.setdefault(scope.owner, scope.first)
    name = os.path.splitext(os.path.basename(file))[0]
    return found + [f"{file}:{line}: defines members of {owner}, which {name}.h does not declare"
                    for owner, line in foreign.items()]


if __name__ == "__main__":
    lines = [fault for file in source_files(sys.argv[1]) for fault in faults_of(sys.argv[1], file)]
    print("\n".join(lines) or "sizes: all classes, functions and sources are within their limits")
    sys.exit(1 if lines else 0)
