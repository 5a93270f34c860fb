"""docstrings.py OUT HEADER...: the docstrings of C++ headers as a header for the bindings.

OUT defines `doc("Camera::project")`, which is the text of the `///` comment above that declaration,
or of the `///<` comment behind it, in the words of Python (python_terms.py); a name without one
does not compile. Names begin behind the namespace placegraph. Of overloads in one header, the first
with a comment counts. A name that has different comments in several headers does not compile
either: it is that of different things.
"""

import re
import sys
from collections.abc import Iterable

from python_terms import python_terms

SCOPE = re.compile(r"\b(?:class|struct|union|enum(?: class)?|namespace)\s+([\w:]+)"
                   r"(?:<[^{}]*>)?(?:\s+final)?[^;()=]*$")
FUNCTION = re.compile(r"(operator\s*[^\s\w(]+|operator\(\)|~?\w+)\s*\(")
ALIAS = re.compile(r"\busing\s+(\w+)\s*=")
FIELD = re.compile(r"(\w+)\s*(?:=.*|\{.*\}|\[.*\])?$", re.DOTALL)
LITERAL = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'')


# Braces that give no name to what is inside.
BODY, VALUE, ENUM = "{body}", "{value}", "{enum}"


class Header:
    """Reads one header line by line: comments wait for the declaration that they explain."""

    def __init__(self) -> None:
        self.docstrings: dict[str, str] = {}
        self.optional: set[str] = set()  # names of what may have no value
        self.enums: set[tuple[str, str]] = set()  # enumerators, each with its enumeration
        self.scopes: list[str] = []  # names, or one of the braces below
        self.comment: list[str] = []  # lines of the comment above
        self.statement = ""  # what was read of the present declaration
        self.last: list[str] = []  # names whose comment may follow behind them
        self.lacking = False  # whether those may have no value
        self.enum = ""  # the enumeration whose enumerators are read

    def read(self, lines: Iterable[str]) -> None:
        for line in lines:
            code, _, behind = line.strip().partition("///<")
            if behind:
                self.declare(code)
                for name in self.last:
                    self.add(name, behind)
            elif code.startswith("///"):
                self.comment.append(code[3:])
            elif code and not code.startswith(("#", "//")):
                self.declare(code.split(" //", 1)[0])

    def add(self, name: str, text: str) -> None:
        known = self.docstrings.get(name)
        if not known and self.lacking:
            self.optional.add(name)
        self.docstrings[name] = f"{known}\n{text.strip()}" if known else text.strip()

    def declare(self, code: str) -> None:
        code = re.sub(r"\[\[.*?\]\] ?", "", LITERAL.sub('""', code))
        if not code:
            return  # a comment behind goes on in the next line
        self.last = []
        for part in re.split(r"([{};])", code):
            if part == "{":
                self.open()
            elif part == "}":
                self.close()
            elif part == ";":
                self.end()
            elif part.strip():
                self.statement = f"{self.statement} {part.strip()}".strip()
        if self.scopes and self.scopes[-1] == ENUM and self.statement:
            self.enumerators()

    def open(self) -> None:
        # What stands before the base classes, without the parameters of a template.
        head = re.sub(r"^template\s*<.*?>\s*", "", self.statement).split(" : ", 1)[0]
        scope = None if "(" in head or BODY in self.scopes else SCOPE.search(head)
        initialized = not scope and self.statement and "(" not in self.statement and self.inside_class()
        if scope:
            self.named(scope.group(1))
            self.enum = scope.group(1)
            self.scopes.append(ENUM if "enum" in self.statement.split() else scope.group(1))
            self.statement = ""
        elif initialized:
            self.scopes.append(VALUE)
            self.statement += "{"
        else:
            self.end()
            self.scopes.append(BODY)

    def close(self) -> None:
        if self.scopes and self.scopes[-1] == ENUM and self.statement:
            self.enumerators()  # they stand in one line with the brace
        if self.scopes and self.scopes.pop() == VALUE:
            self.statement += "}"
        else:
            self.statement = ""

    def inside_class(self) -> bool:
        return BODY not in self.scopes

    def end(self) -> None:
        statement, self.statement = self.statement, ""
        if not statement or BODY in self.scopes:
            return
        statement = re.sub(r"^(?:public|private|protected):\s*", "", statement)
        statement = re.sub(r"^template\s*<.*?>\s*", "", statement)
        without = re.sub(r"<[^<>()]*>", "", re.sub(r"<[^<>()]*>", "", statement))
        found = ALIAS.search(without) or FUNCTION.search(without)
        if found and ("=" not in without[:found.start()] or "operator" in without):
            self.named(found.group(1).replace(" ", ""), statement)
            return
        for each in re.split(r",\s*(?=\w+\s*(?:=|$))", without):
            if name := FIELD.search(each.strip()):
                self.named(name.group(1), statement)

    def enumerators(self) -> None:
        for name in re.findall(r"\b(k\w+)", self.statement):
            self.named(name)
            self.enums.add((name, self.enum))
        self.statement = ""

    def named(self, name: str, statement: str = "") -> None:
        path = [scope for scope in self.scopes if scope[0] != "{" and scope != "placegraph"] + [name]
        full = "::".join(path)
        self.last.append(full)
        self.lacking = "std::optional" in statement.split("(")[0]
        if self.comment and full not in self.docstrings:
            self.add(full, "\n".join(line[1:] if line.startswith(" ") else line for line in self.comment))
        self.comment = [] if not self.last[:-1] else self.comment


def docstrings_of(headers: Iterable[Iterable[str]]) -> dict[str, str]:
    """The docstrings of headers, which are given by their lines."""
    read: list[Header] = []
    enums: dict[str, set[str]] = {}
    for lines in headers:
        header = Header()
        header.read(lines)
        read.append(header)
        for enumerator, enum in header.enums:
            enums.setdefault(enumerator, set()).add(enum)
    texts: dict[str, set[str]] = {}
    for header in read:
        for name, text in header.docstrings.items():
            texts.setdefault(name, set()).add(python_terms(text, enums, name in header.optional))
    return {name: min(different) for name, different in texts.items() if len(different) == 1}


def literal(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def header_text(docstrings: dict[str, str]) -> str:
    rows = "".join(f"    {{{literal(name)}, {literal(text)}}},\n"
                   for name, text in sorted(docstrings.items(), key=lambda item: item[0].encode()))
    return f"""#pragma once
#include <algorithm>
#include <string_view>

namespace placegraph::python {{

struct Docstring {{
  std::string_view name;
  const char* text;
}};
inline constexpr Docstring kDocstrings[] = {{
{rows}}};

/// The docstring of a declaration in the headers; an unknown name does not compile.
consteval const char* doc(std::string_view name) {{
  const auto* found = std::ranges::lower_bound(kDocstrings, name, {{}}, &Docstring::name);
  if (found == std::end(kDocstrings) || found->name != name) throw "no docstring of this name";
  return found->text;
}}

}}  // namespace placegraph::python
"""


def main() -> None:
    headers = []
    for path in sys.argv[2:]:
        with open(path, encoding="utf-8") as lines:
            headers.append(lines.readlines())
    text = header_text(docstrings_of(headers))
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write(text)


if __name__ == "__main__":
    main()
