"""prose.py ROOT: comments, texts and documents use the terms of docs/glossary.md; public declarations have docstrings.

Prints `file:line: ...` for each fault and exits with 1 if there is one. Two rules:
  a word that words.txt refuses, in a comment or a text of the sources outside tests, or in a document (README.md and
  docs/**/*.md but the glossary and elements.md; code between backquotes is left out),
  a type or function at the level of a namespace in a public header without `///` above it, or whose docstring does not
  begin with one line of at most 90 characters that ends a sentence or leads with a colon into what follows.
"""
import pathlib
import re
import sys

from public_headers import public_headers
from source_includes import source_files

LONGEST = 90
PROSE = re.compile(r'(?P<raw>R"(?P<mark>\w*)\(.*?\)(?P=mark)")|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
CODE = re.compile(r"```.*?```|`[^`\n]*`", re.S)
SPELLINGS = "apps/shell/spellings.cpp"  # former names of commands
OPENS = re.compile(r"(template|class|struct|enum|using|inline|constexpr|\[\[)\b|[A-Za-z_][\w:<>,&* ]* [\w:]+\(")
NO_DECLARATION = re.compile(r"(template|friend|return|namespace|using namespace)\b|(class|struct) (\w+;|\w+<)"
                            r"|void visit\(|.*\boperator(==|!=)")


def refused(root):
    for line in (root / "tests/lint/words.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            words, term = line.split("\t")
            yield re.compile(r"\b(?:" + words.replace(" ", r"\s+") + r")\b", re.I), term


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def prose_of(path, text):
    """The text with all that is no prose blanked, in its places."""
    if path.suffix == ".md":
        return CODE.sub(blank, text)
    kept = [" " if c != "\n" else c for c in text]
    for match in PROSE.finditer(text):
        before = text[text.rfind("\n", 0, match.start()) + 1:match.start()]
        if not (before.lstrip().startswith("#include") or re.fullmatch(r'"[\w.\-]*"', match.group(0))):
            kept[match.start():match.end()] = CODE.sub(blank, match.group(0))
    return "".join(kept)


def faults_of_words(root, rules):
    documents = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    sources = [root / file for file in source_files(str(root)) if file != SPELLINGS]
    for path in [p for p in documents if p.name not in ("glossary.md", "elements.md")] + sources:
        prose = prose_of(path, path.read_text(encoding="utf-8"))
        for pattern, term in rules:
            for match in pattern.finditer(prose):
                line = prose.count("\n", 0, match.start()) + 1
                words = " ".join(match.group(0).split())
                yield f"{path.relative_to(root)}:{line}: '{words}'; the term is {term}"


def faults_of_docstrings(file, text):
    above, begin, inside = "", "", False  # the line above, the first line of its comment, a declaration of many lines
    for number, line in enumerate(text.splitlines(), 1):
        if OPENS.match(line) and not NO_DECLARATION.match(line) and not inside:
            if not above.startswith("///"):
                yield f"{file}:{number}: no docstring above: {line.strip()}"
            elif not line.startswith("using") and (len(begin) - 4 > LONGEST or not begin.endswith((".", ":"))):
                yield f"{file}:{number}: its docstring does not begin with one sentence of at most {LONGEST} characters"
        if line[:1] not in ("", " ", "/", "}", "#", ")"):
            inside = not line.endswith((";", "}", "{")) and not line.startswith("template")
        elif inside:
            inside = not line.endswith((";", "}", "{"))
        if line.startswith("///") and not above.startswith("///"):
            begin = line
        if not line.startswith("template"):
            above = line


def main():
    root = pathlib.Path(sys.argv[1])
    faults = list(faults_of_words(root, list(refused(root))))
    for file in public_headers(str(root)):
        faults += faults_of_docstrings(file, (root / file).read_text(encoding="utf-8"))
    print("\n".join(faults) or "prose: every word is one of the glossary, every public declaration has a docstring")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
