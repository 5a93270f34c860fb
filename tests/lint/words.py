"""words.py ROOT [PATH...]: the project's words are those of docs/glossary.md.

Reads words.txt beside it for the words that are refused and words_allowed.txt for the phrases in
which they are allowed. Looks at identifiers of all C++ sources; at comments and texts in quotes of
the sources outside tests; at the documents (README.md, docs/**/*.md but glossary.md and elements.md);
at the sections of the results (scripts/results.d/*.sh and summary.txt), where a key of JSON that
`number FILE KEY` reads is left out. Also refuses a comment that begins with a bare "of". Not read: the table of old
spellings of commands (apps/shell/spellings.cpp), the former keys of options (`formerly("...")`) and
keys of JSON. Prints `file:line: ...` for each fault and exits with 1 if there is one, with 0 and a summary otherwise. With PATH, only files below it are read.
"""
import os
import re
import subprocess
import sys

CODE = ("apps", "backend", "eval", "examples", "frontend", "graph", "io", "pipeline", "tests")
LEFT_OUT = re.compile(r"docs/(glossary|elements)\.md|tests/lint/|tests/mutations/|apps/shell/spellings\.cpp")
SECTION = re.compile(r"scripts/results\.d/(\w+\.sh|summary\.txt)")
JSON_NUMBER = re.compile(r'\bnumber "[^"\n]*" \w+')
FORMER_KEY = re.compile(r"formerly\(\s*$")
MOST_ALLOWED = 30
TOKEN = re.compile(r'(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<include>#[ \t]*include[^\n]*)'
                   r'|(?P<raw>R"(?P<mark>\w*)\(.*?\)(?P=mark)")|(?P<text>"(?:\\.|[^"\\\n])*")'
                   r"|'(?:\\.|[^'\\\n])+'|(?P<name>[A-Za-z_]\w*)", re.S)
WORD_OF_NAME = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
COMMENT_MARK = re.compile(r"^(///<|///|//|/\*+)\s*")
BARE_OF = re.compile(r"of\b", re.I)


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        return [line.rstrip("\n") for line in file if line.strip() and not line.startswith("#")]


def read_rules(path):
    rules = []
    for line in lines_of(path):
        scope, pattern, term = line.split("\t")
        pattern = pattern.replace(" ", r"\s+")
        rules.append((scope, re.compile(rf"\b(?:{pattern})\b", re.I),
                      re.compile(rf"(?:{pattern})", re.I), term))
    return rules


def blanked(text, phrases):
    """The text without the allowed phrases, with the same positions."""
    for phrase in phrases:
        text = phrase.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)
    return text


class Words:
    def __init__(self, folder):
        self.rules = read_rules(os.path.join(folder, "words.txt"))
        allowed = lines_of(os.path.join(folder, "words_allowed.txt"))
        if len(allowed) > MOST_ALLOWED:
            raise SystemExit(f"words_allowed.txt: {len(allowed)} phrases, {MOST_ALLOWED} are allowed")
        self.phrases = [re.compile(r"(?<!\w)" + re.escape(p).replace(r"\ ", r"\s+") + r"(?!\w)", re.I) for p in allowed]

    def in_prose(self, text):
        """(offset, word, term) of each refused word. Quoted code (`...`) is left out."""
        text = re.sub(r"`[^`\n]*`", lambda m: " " * len(m.group(0)), blanked(text, self.phrases))
        for scope, whole, _, term in self.rules:
            if scope in ("any", "prose"):
                for match in whole.finditer(text):
                    yield match.start(), match.group(0), term

    def in_name(self, name, scopes=("any", "name")):
        plain = name.replace("_", " ").strip()
        words = WORD_OF_NAME.findall(blanked(plain, self.phrases))
        for word in words:
            for scope, _, exact, term in self.rules:
                if scope in scopes and exact.fullmatch(word):
                    yield word, term


def line_at(text, offset):
    return text.count("\n", 0, offset) + 1


def is_name_of_data(token, text):
    """A key of JSON, or the former key of an option: files have it, whatever the term is now."""
    if not token.group("text") or not re.fullmatch(r'"\w+"', token.group("text")):
        return False
    before = text[max(0, token.start() - 40):token.start()]
    return bool(re.search(r"(?<!IsMember\()(?<!\w\()[{\[]$", before) or FORMER_KEY.search(before))


def code_faults(words, file, text):
    in_tests = file.startswith("tests/")
    original, text = text, blanked(text, words.phrases)
    previous = None  # line on which the comment before ended
    for token in TOKEN.finditer(text):
        line = line_at(text, token.start())
        if token.group("name"):
            scopes = ("any", "name") if in_tests else ("any", "name", "library")
            for word, term in words.in_name(token.group("name"), scopes):
                yield line, f"{token.group('name')}: '{word}'; the term is {term}"
        elif in_tests or token.group("include") or is_name_of_data(token, text):
            continue
        else:
            key = re.fullmatch(r'"(?:--)?([\w-]+)"', token.group(0))  # of an option, or a flag
            for word, term in words.in_name(key.group(1).replace("-", "_")) if key else ():
                yield line, f"{token.group(0)}: '{word}'; the term is {term}"
            for offset, word, term in words.in_prose(token.group(0)):
                yield line + token.group(0).count("\n", 0, offset), f"'{word}'; the term is {term}"
            if token.group("comment"):
                begins = original[token.start():token.end()]
                alone = text[:token.start()].rsplit("\n", 1)[-1].strip() == ""
                goes_on = previous == line - 1 and (alone or begins.startswith("///<")) and not (
                    begins.startswith("///<") and not alone)
                if not goes_on and BARE_OF.match(COMMENT_MARK.sub("", begins)):
                    yield line, "a comment begins with a bare 'of': name the thing"
                previous = line + token.group(0).count("\n")


def document_faults(words, text):
    text = re.sub(r"```.*?```", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)
    for offset, word, term in words.in_prose(text):
        yield line_at(text, offset), f"'{word}'; the term is {term}"


def section_faults(words, text):
    text = JSON_NUMBER.sub(lambda match: " " * len(match.group(0)), text)
    for offset, word, term in words.in_prose(text):
        yield line_at(text, offset), f"'{word}'; the term is {term}"


def tracked(root, paths):
    listed = subprocess.run(["git", "-C", root, "ls-files", "--", *paths], capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return listed.stdout.splitlines()
    found = []  # a tree without git
    for folder, _, names in os.walk(root):
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names]
    return sorted(file for file in found if not paths or any(file.startswith(p) for p in paths))


def main():
    root, paths = sys.argv[1], sys.argv[2:]
    words = Words(os.path.dirname(os.path.abspath(__file__)))
    faults, files = 0, 0
    for file in tracked(root, paths):
        if LEFT_OUT.match(file):
            continue
        is_code = file.endswith((".h", ".cpp")) and file.split("/")[0] in CODE
        is_document = file == "README.md" or (file.startswith("docs/") and file.endswith(".md"))
        judge = code_faults if is_code else document_faults if is_document else \
            section_faults if SECTION.fullmatch(file) else None
        if judge is None:
            continue
        files += 1
        with open(os.path.join(root, file), encoding="utf-8") as source:
            text = source.read()
        arguments = (words, file, text) if is_code else (words, text)
        for line, fault in sorted(judge(*arguments)):
            faults += 1
            print(f"{file}:{line}: {fault}")
    print(f"words: {faults} faults in {files} files")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
