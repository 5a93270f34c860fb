"""The words of C++ comments as those of Python, where a rule is safe.

What no rule translates stays as it is; python/tests/test_docstrings.py finds it, and the binding
then needs a text of its own.
"""

import re
from collections.abc import Mapping

# The enumerations that are enumerations in Python, too; the others are strings there.
PYTHON_ENUMS = frozenset({"Distortion", "Sensor", "TrackingState", "TrajectoryFormat"})

WORDS = (
    (re.compile(r"\bThrows\b"), "Raises"),
    (re.compile(r"\bthrows\b"), "raises"),
    (re.compile(r"\bthrown\b"), "raised"),
    (re.compile(r"\bthrow\b"), "raise"),
    (re.compile(r"\brun_sequence\b"), "run"),
    (re.compile(r"\boptimize_pose_graph\b"), "optimize"),
    (re.compile(r"\boptimize_factor_graph\b"), "optimize_factors"),
    (re.compile(r"\bstd::nullopt\b|\bnullptr\b"), "None"),
    (re.compile(r"\bstd::string(?:_view)?\b"), "str"),
    (re.compile(r"\bstd::(?=\w)"), ""),
    (re.compile(r"\b([A-Za-z]\w*)::(?=~?\w)"), r"\1."),
    (re.compile(r"`true`|\btrue(?=:)"), "True"),
    (re.compile(r"`false`|\bfalse(?=:)"), "False"),
    (re.compile(r"(`\w+` is )true\b"), r"\1True"),
    (re.compile(r"(`\w+` is )false\b"), r"\1False"),
)
# The value that an optional declaration lacks: "nothing if ...".
ABSENT = re.compile(r"\b(?:[Nn]othing|(?<=; )none)(?=\s+(?:if|unless|where|when|while|until|before|"
                    r"after|without|outside|beside|for)\b)")
IMAGE = re.compile(r"\bCV_(8|16|32|64)([USF])(?:C(\d))?\b")
ENUMERATOR = re.compile(r"\b(?:(\w+)(?:::|\.))?(k[A-Z]\w*)")
KINDS = {"U": "uint", "S": "int", "F": "float"}


def words_of(enumerator: str) -> list[str]:
    """The words of an enumerator: kTooFewData has too, few and data."""
    return [word.lower() for word in re.findall(r"[A-Z][a-z0-9]*", enumerator)]


def image(match: re.Match[str]) -> str:
    bits, kind, channels = match.groups()
    shape = "H x W" if channels in (None, "1") else f"H x W x {channels}"
    colours = " (BGR)" if (bits, kind, channels) == ("8", "U", "3") else ""
    return f"{shape} {KINDS[kind]}{bits}{colours}"


def python_terms(text: str, enums: Mapping[str, set[str]], optional: bool = False) -> str:
    """A comment in the words of Python.

    `enums` are the enumerations that have an enumerator; `optional`: the declaration may lack a
    value, which is None then.
    """
    def enumerator(match: re.Match[str]) -> str:
        name = match.group(2)
        owners = {match.group(1)} & enums.get(name, set()) or enums.get(name, set())
        if not owners or len(owners) > 1 and owners & PYTHON_ENUMS:
            return match.group()  # a constant, or nobody knows of which enumeration
        if owners <= PYTHON_ENUMS:
            return f"{min(owners)}.{'_'.join(words_of(name)).upper()}"
        return '"' + " ".join(words_of(name)) + '"'

    text = ENUMERATOR.sub(enumerator, text)
    for pattern, term in WORDS:
        text = pattern.sub(term, text)
    text = IMAGE.sub(image, text)
    return ABSENT.sub("None", text) if optional else text
