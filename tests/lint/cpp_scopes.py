"""Finds the classes and functions of a C++ source: what they are called and which lines they take.

A scanner of braces and no parser: what stands before a brace, since the last ';', '{' or '}' of the
same scope, tells whether a namespace, a class, an enumeration or a function begins there. Macros are
not looked into; braces must balance with all branches of the preprocessor in place.
"""
import re
from typing import NamedTuple

from source_includes import without_comments

CLASS = re.compile(r"\b(?:class|struct|union)\s+(?:\[\[[^\]]*\]\]\s*|alignas\([^)]*\)\s*)*((?:[A-Za-z_]\w*::)*[A-Za-z_]\w*)")
# A member's initializer: "A::A() : a(1), b" before the brace of b's value.
INITIALIZER = re.compile(r"\)\s*(?:noexcept\s*)?:(?!:).*[\w>]\s*$", re.S)
NAMESPACE = re.compile(r"\bnamespace\b|\bextern\s+\"\"")
OPERATOR = r"operator\s*(?:\(\s*\)|[^\s\w(]+|[\w:]+[\s\w:<>*&,]*)"
NAME = rf"({OPERATOR}|~?[A-Za-z_]\w*)\s*\($"
QUALIFIED = re.compile(rf"([A-Za-z_]\w*)\s*(?:<(?:[^<>()]|<[^<>()]*>)*>)?\s*::\s*{NAME}")
PLAIN = re.compile(NAME)


class Scope(NamedTuple):
    kind: str     # "class" or "function"
    name: str     # without the class that it is qualified by
    owner: str    # the class named before "::" in a definition outside of it, else empty
    first: int    # line on which the head begins, counted from 1
    last: int     # line of the closing brace
    body: int     # line of the opening brace

    @property
    def lines(self):
        return self.last - self.first + 1


def without_literals(text):
    """The text with the same lines, without comments, preprocessor lines and contents of literals."""
    text = re.sub(r'R"([^(\s]*)\((?:.*?)\)\1"', lambda m: '""' + "\n" * m.group(0).count("\n"), text,
                  flags=re.S)
    text = re.sub(r"\b\d[\w.]*(?:'[0-9a-fA-F]+)+", lambda m: m.group(0).replace("'", ""), text)
    text = without_comments(text)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"'(?:\\.|[^'\\\n])*'", "''", text)
    return re.sub(r"^[ \t]*#(?:[^\n\\]|\\.)*(?:\\\n[^\n]*)*",
                  lambda m: "\n" * m.group(0).count("\n"), text, flags=re.M)


def _without_templates(head):
    """The head without its "template <...>" parts."""
    while True:
        match = re.search(r"\btemplate\s*<", head)
        if not match:
            return head
        depth, at = 1, match.end()
        while at < len(head) and depth:
            depth += {"<": 1, ">": -1}.get(head[at], 0)
            at += 1
        head = head[:match.start()] + head[at:]


def _assigns(head):
    """Whether a value is given, which an operator's name is not."""
    head = re.sub(r"operator\s*[^\s\w(]+", "operator", head)
    return re.search(r"(?<![=!<>])=(?!=)", head) is not None


def _first_parenthesis(head):
    """Index of the first '(' that opens a list of parameters, or -1."""
    call = re.search(r"\boperator\s*\(\s*\)\s*\(", head)
    if call:
        return call.end() - 1
    for match in re.finditer(r"\(", head):
        before = head[:match.start()].rstrip()
        if not re.search(r"\b(?:alignas|decltype|noexcept|requires|__attribute__)$", before):
            return match.start()
    return -1


def classify(head):
    """(kind, name, owner) of the scope that the head opens; kind "other" for blocks and values."""
    head = _without_templates(head.replace("<<", "  ")).strip()
    if re.fullmatch(r"(?:static\s+|const\s+)*(?:class|struct|union)", head):
        return "class", "(unnamed)", ""
    if NAMESPACE.search(head):
        return "namespace", "", ""
    at = _first_parenthesis(head)
    found = CLASS.search(head if at < 0 else head[:at])
    if re.match(r"(?:typedef\s+)?enum\b", head):
        return "other", "", ""
    if found and (at < 0 or not re.search(r"[\w&*>]\s+[\w:~]+\s*$", head[found.end():at])):
        if "=" not in head:
            return "class", found.group(1).rsplit("::", 1)[-1], ""
    lambda_head = re.search(r"([A-Za-z_]\w*)\s*=\s*\[[^\[\]]*\]\s*(?:\(.*)?$", head, re.S)
    if lambda_head and "operator" not in head:
        return "function", lambda_head.group(1), ""
    if at < 0 or _assigns(head[:at]):
        return "other", "", ""
    before = head[:at + 1]
    if INITIALIZER.search(head):
        return "other", "", ""
    match = QUALIFIED.search(before)
    if match:
        return "function", match.group(2).strip(), match.group(1)
    match = PLAIN.search(before)
    return ("function", match.group(1).strip(), "") if match else ("other", "", "")


def scopes_of(text):
    """The classes and functions of a source text, nested classes and their functions too. A lambda
    that is a variable of a namespace or class counts as a function, those inside of functions as
    part of these. Throws ValueError, with the line first, where braces do not balance."""
    text = without_literals(text)
    found, open_scopes = [], []
    line, head, head_line, parentheses = 1, "", 0, 0
    for character in text:
        if character == "\n":
            line += 1
        inside = open_scopes and open_scopes[-1][0] in ("function", "other")
        if character == "{":
            kind = ("other", "", "") if inside or parentheses else classify(head)
            if parentheses or (kind[0] == "other" and not inside):
                open_scopes.append(("other", "", "", head_line or line, line, head, parentheses))
            else:
                open_scopes.append((*kind, head_line or line, line, "", 0))
            head, head_line, parentheses = "", 0, 0
        elif character == "}":
            if not open_scopes:
                raise ValueError(f"{line}: a brace is closed that was not opened")
            kind, name, owner, first, body, before, outer = open_scopes.pop()
            if kind in ("class", "function"):
                found.append(Scope(kind, name, owner, first, line, body))
            head, head_line, parentheses = before and before + "{}", first if before else 0, outer
        elif inside:
            continue
        elif character == ";" and not parentheses:
            head, head_line = "", 0
        else:
            parentheses += {"(": 1, ")": -1}.get(character, 0)
            head += character
            if character == ":" and head.strip() in ("public:", "private:", "protected:"):
                head, head_line = "", 0
            elif not head_line and not character.isspace():
                head_line = line
    if open_scopes:
        raise ValueError(f"{open_scopes[-1][4]}: a brace is not closed")
    return sorted(found, key=lambda scope: (scope.first, scope.last))
