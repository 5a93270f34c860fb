"""sizes.py ROOT: no source over 400 lines, no class declaration over 150, no function over 60, no slice of a class,
and no class of one name in two headers of a namespace, of which the linker would take either one's functions.

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
NAMESPACE = re.compile(r"^namespace (?:\[\[[^\]]*\]\] )?([\w:]+)", re.M)
CLASS = re.compile(r"^(?:class|struct|enum class) (\w+)[^;{]*\{", re.M)


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


def same_names(root):
    """Classes that two headers define in the same namespace."""
    first, found = {}, []
    for file in sorted(source_files(root)):
        if not file.endswith(".h") or file.startswith("tests/"):
            continue
        with open(os.path.join(root, file), encoding="utf-8") as source:
            text = source.read()
        namespace = NAMESPACE.search(text)
        for match in CLASS.finditer(text):
            other = first.setdefault((namespace and namespace.group(1), match.group(1)), file)
            if other != file:
                found.append(f"{file}:{text.count(chr(10), 0, match.start()) + 1}: class {match.group(1)} "
                             f"is also in {other}")
    return found


if __name__ == "__main__":
    lines = [fault for file in source_files(sys.argv[1]) for fault in faults_of(sys.argv[1], file)]
    lines += same_names(sys.argv[1])
    print("\n".join(lines) or "sizes: all classes, functions and sources are within their limits")
    sys.exit(1 if lines else 0)
