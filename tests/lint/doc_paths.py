"""doc_paths.py ROOT: every file and folder of the project that its documents name exists.

Reads README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md below ROOT; prints one line for each
violation as file:line, and fails if there is one. Checked are
  words in backticks or code blocks that begin with a folder of the project:
    `io/graphs/`, `scripts/demo`, `backend/solver/*.h`, `io/graphs/{g2o,toro}`,
    `backend/window/sliding_window` for the pair of .h and .cpp, `tests/unit/<folder>` up to the
    placeholder;
  headers after `#include <placegraph/`;
  names of a .h or .cpp file alone, which must be those of a file of the project;
  members such as `Slam::finish`, whose names occur in the sources (CHANGELOG.md may name those
    that are gone);
  pages such as docs/map.md, in prose, too;
  relative links, also those named below a text (`[page]: path`), and the headings that they lead to;
  the length of lines, at most 120 characters, but in CHANGELOG.md.
"""
import glob
import os
import re
import sys

FOLDERS = ("graph", "frontend", "backend", "io", "eval", "pipeline", "apps", "examples", "tests",
           "docs", "scripts", "configs", "cmake", ".ci")
WORD = re.compile(r"(?<![\w./:-])(?:placegraph/)?(?:%s)/[\w./*{},<>-]*" %
                  "|".join(re.escape(folder) for folder in FOLDERS))
INCLUDE = re.compile(r"#include <placegraph/([^>]+)>")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
NAMED_LINK = re.compile(r"^\[[^\]]+\]:\s+(\S+)", re.M)
LINE_LENGTH = 120
CODE = re.compile(r"(?<!`)(`+)(?!`)((?:[^\n]|\n(?!\n))+?)(?<!`)\1(?!`)")
MEMBER = re.compile(r"(?!std::|cv::|placegraph::)[A-Z]\w*(::\w+)+$")
SOURCE = re.compile(r"\w+\.(h|cpp)$")
FENCE = re.compile(r"\s*(```|~~~)")


def documents(root):
    names = [name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
             if os.path.exists(os.path.join(root, name))]
    below = glob.glob(os.path.join(root, "docs", "**", "*.md"), recursive=True)
    return names + sorted(os.path.relpath(path, root) for path in below)


def expanded(word):
    """The words that the braces of one stand for."""
    match = re.search(r"\{([^{}]*)\}", word)
    if not match:
        return [word]
    return [full for choice in match.group(1).split(",")
            for full in expanded(word[:match.start()] + choice.strip() + word[match.end():])]


def exists(root, word):
    if word.startswith("placegraph/"):
        word = word[len("placegraph/"):]
    if "<" in word:
        word = os.path.dirname(word.split("<", 1)[0]) + "/"
    path = os.path.join(root, word.rstrip("."))
    if path.endswith("/"):
        return os.path.isdir(path)
    if "*" in path:
        return bool(glob.glob(path))
    return os.path.exists(path) or any(os.path.exists(path + end) for end in (".h", ".cpp"))


def words_of(text):
    for match in WORD.finditer(text):
        yield match.group(0).rstrip(",.>" if "<" not in match.group(0) else ",.")


def headings(path):
    """The anchors of a document's headings, as GitHub makes them."""
    found, fenced = {}, False
    with open(path, encoding="utf-8") as text:
        for line in text:
            if FENCE.match(line):
                fenced = not fenced
            match = None if fenced else re.match(r"#+\s+(.*?)\s*#*$", line)
            if match:
                plain = LINK.sub(lambda m: m.group(0)[1:m.group(0).index("]")], match.group(1))
                anchor = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
                times = found[anchor] = found.get(anchor, -1) + 1
                if times:
                    found[f"{anchor}-{times}"] = 0
    return found


def link_fault(root, document, link):
    """What is wrong with a relative link, or nothing."""
    if re.match(r"[a-z]+:", link):
        return None
    target, _, anchor = link.partition("#")
    path = os.path.join(root, os.path.dirname(document), target) if target else \
        os.path.join(root, document)
    if not os.path.exists(path):
        return f"the link leads nowhere: {link}"
    if anchor and path.endswith(".md") and anchor not in headings(path):
        return f"no heading of this name: {link}"
    return None


def parts_of(text):
    """(line, code) of each piece of code, and the text without its code blocks."""
    pieces, prose, fenced = [], [], False
    for number, line in enumerate(text.split("\n"), 1):
        fence = bool(FENCE.match(line))
        if fenced and not fence:
            pieces.append((number, line))
        prose.append("" if fenced or fence else line)
        fenced ^= fence
    prose = "\n".join(prose)
    for match in CODE.finditer(prose):
        pieces.append((1 + prose.count("\n", 0, match.start(2)), match.group(2)))
    return pieces, prose


def named_in(code):
    """The files and folders that a piece of code names; white space within braces is no end."""
    code = re.sub(r"\{[^{}]*\}", lambda braces: re.sub(r"\s+", "", braces.group(0)), code)
    headers = ["pipeline/placegraph.h" if header == "placegraph.h" else header  # it is installed above its folder
               for header in INCLUDE.findall(code)]
    return headers or [full for word in words_of(code) for full in expanded(word)]


def check_document(root, document, sources, words):
    with open(os.path.join(root, document), encoding="utf-8") as text:
        text = text.read()
    pieces, prose = parts_of(text)
    found = []
    if document != "CHANGELOG.md":
        found = [(number, f"a line of {len(line)} characters, {LINE_LENGTH} are allowed")
                 for number, line in enumerate(text.split("\n"), 1) if len(line) > LINE_LENGTH]
    for line, code in pieces:
        missing = [word for word in named_in(code) if not exists(root, word)]
        if SOURCE.match(code) and code not in sources:
            missing.append(code)
        if MEMBER.match(code) and document != "CHANGELOG.md":
            found += [(line, f"no such name in the sources: {name}")
                      for name in code.split("::") if name not in words]
        found += [(line, f"no such file or folder: {word}") for word in missing]
    plain = CODE.sub(lambda code: "\n" * code.group(0).count("\n"), LINK.sub("", prose))
    for match in WORD.finditer(plain):
        page = match.group(0).rstrip(".,")
        if page.endswith(".md") and not exists(root, page):
            found.append((1 + plain.count("\n", 0, match.start()),
                          f"no such file or folder: {page}"))
    for match in [*LINK.finditer(prose), *NAMED_LINK.finditer(prose)]:
        fault = link_fault(root, document, match.group(1))
        if fault:
            found.append((1 + prose.count("\n", 0, match.start()), fault))
    return [f"{document}:{line}: {fault}" for line, fault in sorted(found)]


def source_names(root):
    """The names, without folders, of all files below the folders of the project."""
    return {name for folder in FOLDERS for _, _, names in os.walk(os.path.join(root, folder))
            for name in names}


def source_words(root):
    """All words of the headers and sources of the project."""
    words = set()
    for folder in FOLDERS:
        for path in glob.glob(os.path.join(root, folder, "**", "*"), recursive=True):
            if path.endswith((".h", ".cpp")):
                with open(path, encoding="utf-8", errors="replace") as text:
                    words.update(re.findall(r"\w+", text.read()))
    return words


def main():
    root = sys.argv[1]
    names = documents(root)
    if not names:
        print(f"{root}: no documents")
        return 2
    sources, words = source_names(root), source_words(root)
    found = [line for document in names for line in check_document(root, document, sources, words)]
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
