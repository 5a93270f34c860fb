"""sizes.py ROOT: no class declaration over 150 lines, no function over 60, no slice of a class.

A slice of a class is a source that defines member functions of a class which is declared elsewhere
in a header of another name: "line_cue_views.cpp" with functions of LineCue. A source may define
members of every class that it, or the header of its own name, declares.
"""
import os
import re
import sys

from cpp_scopes import scopes_of
from source_includes import source_files

CLASS_LINES, FUNCTION_LINES = 150, 60


def classes_of(root, file):
    path = os.path.join(root, file)
    if not os.path.exists(path):
        return set()
    with open(path, encoding="utf-8") as source:
        return {scope.name for scope in scopes_of(source.read()) if scope.kind == "class"}


def faults(root):
    found = []
    for file in source_files(root):
        with open(os.path.join(root, file), encoding="utf-8") as source:
            scopes = scopes_of(source.read())
        own = {scope.name for scope in scopes if scope.kind == "class"}
        foreign = {}
        for scope in scopes:
            limit = CLASS_LINES if scope.kind == "class" else FUNCTION_LINES
            if scope.lines > limit:
                found.append(f"{file}:{scope.first}: {scope.kind} {scope.name} has {scope.lines} "
                             f"lines, {limit} are allowed")
            if scope.owner and scope.owner not in own:
                foreign.setdefault(scope.owner, scope.first)
        if foreign and file.endswith(".cpp"):
            own |= classes_of(root, re.sub(r"\.cpp$", ".h", file))
            found += [f"{file}:{line}: defines members of {owner}, which {os.path.basename(file)[:-4]}.h "
                      "does not declare" for owner, line in foreign.items() if owner not in own]
    return found


if __name__ == "__main__":
    lines = faults(sys.argv[1])
    print("\n".join(lines) or "sizes: all classes, functions and sources are within their limits")
    sys.exit(1 if lines else 0)
