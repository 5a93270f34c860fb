"""docstrings.py ROOT: every public declaration of the public headers has a docstring.

Prints one line `file:line: ...` for each fault and exits with 1 if there is one, with 0 and a
summary if there is none, with 2 and one line if clang's bindings are missing or the headers do not
parse. Needs python3-clang-16. Faults:
  a type, an alias, a concept or a function without `///` above it,
  a type or a function whose docstring does not begin with one line of at most 90 characters that
  ends a sentence with a period, or leads with a colon into what follows,
  a field or constant without `///` above or `///<` behind it; one comment is enough for fields that
  are declared together, as in `double fx, fy;  ///< [px]`.
Not asked for: what is private, protected or in a namespace `internal`; enumerators, whose names may
say all; destructors, copy, move, defaulted and deleted functions; comparison and assignment
operators; `check()` and `visit()`, whose contract stands in graph/core/options.h; definitions of
what was declared before; specializations, whose contract is that of the template.
"""
import glob
import os
import re
import sys
import tempfile

from public_headers import is_public
from source_includes import LAYERS, source_files

try:
    from clang import cindex
    from clang.cindex import AccessSpecifier, AvailabilityKind, CursorKind
except ImportError:
    print("docstrings: clang's Python bindings are missing; install python3-clang-16")
    sys.exit(2)

LIBCLANG = "/usr/lib/llvm-16/lib/libclang.so.1"
LONGEST = 90
OPTIONS_CONTRACT = ("check", "visit")
EXEMPT_OPERATOR = re.compile(r"operator(=|==|!=|<|>|<=|>=|<=>)$")

CONCEPT_DECL = getattr(CursorKind, "CONCEPT_DECL", None) or CursorKind(604)  # clang 16 lacks its name
TYPES = (CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.UNION_DECL,
         CursorKind.ENUM_DECL, CursorKind.CLASS_TEMPLATE)
ALIASES = (CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPE_ALIAS_TEMPLATE_DECL,
           CursorKind.TYPEDEF_DECL, CONCEPT_DECL)
FUNCTIONS = (CursorKind.FUNCTION_DECL, CursorKind.FUNCTION_TEMPLATE, CursorKind.CXX_METHOD,
             CursorKind.CONSTRUCTOR, CursorKind.CONVERSION_FUNCTION)
VALUES = (CursorKind.FIELD_DECL, CursorKind.VAR_DECL)
HIDDEN = (AccessSpecifier.PRIVATE, AccessSpecifier.PROTECTED)


class UnreadableHeaders(Exception):
    """The headers do not parse; the message is one line."""


def public_headers(root):
    return [file for file in source_files(root) if is_public(file)]


def parsed(root, headers, include_folder):
    """One translation unit that includes all headers, as <placegraph/...> below `include_folder`."""
    os.mkdir(os.path.join(include_folder, "placegraph"))
    for layer in LAYERS:
        if os.path.isdir(os.path.join(root, layer)):
            os.symlink(os.path.join(os.path.abspath(root), layer),
                       os.path.join(include_folder, "placegraph", layer))
    resources = sorted(glob.glob(os.path.join(os.path.dirname(LIBCLANG), "clang", "*")))
    if not os.path.exists(LIBCLANG) or not resources:
        raise UnreadableHeaders(f"no {LIBCLANG} or no clang headers beside it; install python3-clang-16")
    if not cindex.Config.loaded:
        cindex.Config.set_library_file(LIBCLANG)
    source = "".join(f"#include <placegraph/{header}>\n" for header in headers)
    arguments = ["-std=c++20", "-xc++", "-I" + include_folder, "-isystem", "/usr/include/eigen3",
                 "-isystem", "/usr/include/opencv4", "-DEIGEN_MAX_ALIGN_BYTES=16", "-DEIGEN_MALLOC_ALREADY_ALIGNED=1",
                 "-resource-dir", resources[-1]]
    unit = cindex.Index.create().parse(
        "all_public_headers.cpp", arguments, [("all_public_headers.cpp", source)],
        cindex.TranslationUnit.PARSE_SKIP_FUNCTION_BODIES)
    for diagnostic in unit.diagnostics:
        if diagnostic.severity >= cindex.Diagnostic.Error:
            file = diagnostic.location.file
            place = f"{file_of(file.name, include_folder)}:{diagnostic.location.line}: " if file else ""
            raise UnreadableHeaders(f"{place}does not parse: {diagnostic.spelling}")
    return unit


def file_of(path, include_folder):
    """The path below the root of a header that was included, else the path."""
    prefix = os.path.join(include_folder, "placegraph") + os.sep
    return path[len(prefix):] if path.startswith(prefix) else path


def is_exempt(cursor):
    """Whether a function or type needs no docstring, see above."""
    if cursor.kind in TYPES:
        return not cursor.is_definition() or is_specialization(cursor)
    if cursor.kind not in FUNCTIONS:
        return False
    if cursor.canonical != cursor or cursor.availability == AvailabilityKind.NOT_AVAILABLE:
        return True
    if cursor.kind == CursorKind.CONSTRUCTOR and (cursor.is_copy_constructor()
                                                  or cursor.is_move_constructor()):
        return True
    return (cursor.is_default_method() or cursor.spelling in OPTIONS_CONTRACT
            or EXEMPT_OPERATOR.match(cursor.spelling) is not None)


def is_specialization(cursor):
    return cursor.kind != CursorKind.CLASS_TEMPLATE and cursor.get_num_template_arguments() > 0


def name_of(cursor):
    """The name with the types it stands in: Camera::project, GraphChange::nodes."""
    name, parent = cursor.spelling or "(without a name)", cursor.semantic_parent
    while parent is not None and parent.kind in TYPES:
        name, parent = f"{parent.spelling}::{name}", parent.semantic_parent
    return name


def first_line_fault(comment):
    """What is wrong with the first line of the docstring of a type or function, if anything."""
    if not comment.startswith("///") or comment.startswith("///<"):
        return "its docstring does not stand above it behind ///"
    line = comment.split("\n", 1)[0][3:].strip()
    if len(line) > LONGEST:
        return f"the first line of its docstring has {len(line)} characters, {LONGEST} are allowed"
    if not line.endswith((".", ":")):
        return "the first line of its docstring does not end a sentence"
    return ""


class Declarations:
    """Visits the public declarations of the headers once, and keeps the faults it finds."""

    def __init__(self, headers, include_folder):
        self.headers = set(headers)
        self.include_folder = include_folder
        self.count = 0
        self.faults = []  # (file, line, text)

    def visit(self, parent):
        together = {}  # where a declaration of fields begins: the fields and their type, if new
        for cursor in parent.get_children():
            if cursor.kind == CursorKind.FRIEND_DECL:
                for friend in cursor.get_children():
                    if friend.kind in FUNCTIONS:
                        self.judge(friend)
            elif cursor.access_specifier in HIDDEN:
                continue
            elif cursor.kind in (CursorKind.NAMESPACE, CursorKind.LINKAGE_SPEC):
                if cursor.spelling not in ("internal", "std"):
                    self.visit(cursor)
            else:
                if cursor.kind in VALUES + TYPES:
                    start = cursor.extent.start
                    together.setdefault((str(start.file), start.offset), []).append(cursor)
                self.judge(cursor)
        for declared in together.values():
            self.judge_values(declared)

    def where(self, cursor):
        """File and line of a cursor in a public header, nothing elsewhere."""
        file = cursor.location.file
        name = file_of(file.name, self.include_folder) if file else ""
        return (name, cursor.location.line) if name in self.headers else None

    def add(self, cursor, text):
        self.faults.append((*self.where(cursor), f"{name_of(cursor)}: {text}"))

    def judge(self, cursor):
        if cursor.kind not in TYPES + ALIASES + FUNCTIONS or not self.where(cursor):
            return
        if is_exempt(cursor):
            return
        if cursor.spelling and not cursor.is_anonymous():
            self.count += 1
            if not cursor.raw_comment:
                self.add(cursor, "no docstring")
            elif cursor.kind not in ALIASES:
                fault = first_line_fault(cursor.raw_comment)
                if fault:
                    self.add(cursor, fault)
        if cursor.kind in TYPES and cursor.kind != CursorKind.ENUM_DECL:
            self.visit(cursor)

    def judge_values(self, declared):
        values = [value for value in declared if value.kind in VALUES and self.where(value)
                  and value.spelling and value.canonical == value]
        self.count += len(values)
        if not any(cursor.raw_comment for cursor in declared):
            for value in values:
                self.add(value, "no docstring")


def check(root):
    headers = public_headers(root)
    if not headers:
        raise UnreadableHeaders(f"{root}: no public headers")
    with tempfile.TemporaryDirectory() as include_folder:
        declarations = Declarations(headers, include_folder)
        declarations.visit(parsed(root, headers, include_folder).cursor)
    found = [f"{file}:{line}: {text}" for file, line, text in sorted(set(declarations.faults))]
    return found, declarations.count, len(headers)


if __name__ == "__main__":
    try:
        found_faults, declaration_count, header_count = check(sys.argv[1])
    except (UnreadableHeaders, cindex.LibclangError) as error:
        print(f"docstrings: {str(error).splitlines()[0]}")
        sys.exit(2)
    print("\n".join(found_faults)
          or f"docstrings: {declaration_count} declarations of {header_count} headers, all documented")
    sys.exit(1 if found_faults else 0)
