"""elements.py ROOT [PROGRAM]: docs/elements.md maps the items of the thesis to what exists.

Reads docs/elements.md below ROOT. Its tables have the columns
  the thesis | our term | file | command | test
and stand below lines that name the folders of their files and tests:
  Files: `a/b/`, `a/{c,d}/`. Tests: `tests/unit/b/`.
Checked is that
  every path in backquotes exists: in a table below one of these folders or below ROOT, a file with or
    without .h, .cpp or .in, a test with or without _test.cpp, and below one folder only;
  every row has five cells that are filled; file, command and test name something in backquotes, unless
    the command is "library only" or file and command are "none" and the test is
    "not built, because ...";
  tests are below tests/, and commands are `placegraph ...` or a script;
  equations 2.1 to 2.10 have a row each;
  every command of PROGRAM is one: `PROGRAM words --help` exits with 0 and prints a help that is not the
    one of the words before. (CLI11 answers an unknown word before --help with the help of the group.)
Prints docs/elements.md:LINE: for each fault and exits with 1 if there is one, with 0 and a summary otherwise.
"""
import os
import re
import subprocess
import sys

PAGE = "docs/elements.md"
COLUMNS = ["the thesis", "our term", "file", "command", "test"]
EQUATIONS = [f"2.{number}" for number in range(1, 11)]
CODE = re.compile(r"`([^`]+)`")
EQUATION = re.compile(r"\beq\. (2\.\d+)\b")
NOT_BUILT = re.compile(r"not built, because \w")
SEPARATOR = re.compile(r"\|(\s*:?-+:?\s*\|)+$")
FILE_ENDS, TEST_ENDS = (".h", ".cpp", ".in", ""), ("_test.cpp", ".cpp", "")


def expanded(path):
    """The paths that the braces of one stand for."""
    match = re.search(r"\{([^{}]*)\}", path)
    if not match:
        return [path]
    return [full for choice in match.group(1).split(",")
            for full in expanded(path[:match.start()] + choice.strip() + path[match.end():])]


def paths_of(root, name, folders, ends):
    """The files (without their ends) that a name may be below some folders or the root."""
    return sorted({os.path.normpath(os.path.join(folder, name)) for folder in [*folders, ""]
                   if any(os.path.isfile(os.path.join(root, folder, name + end)) for end in ends)})


def cells_of(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


class Page:
    """The page, read line by line: its faults, rows and commands."""

    def __init__(self, root):
        self.root, self.faults, self.equations, self.commands = root, [], set(), {}
        self.rows = self.not_built = self.library_only = 0
        self.folders, self.paragraph = {"Files": [], "Tests": []}, []

    def fault(self, line, text):
        self.faults.append((line, text))

    def read(self, lines):
        in_table = False
        for number, line in enumerate(lines, 1):
            if not line.startswith("|"):
                in_table = False
                self.read_prose(number, line)
            elif not in_table:
                in_table = True
                if cells_of(line) != COLUMNS:
                    self.fault(number, f"a table has other columns than {' | '.join(COLUMNS)}")
            elif not SEPARATOR.match(line.strip()):
                self.read_row(number, cells_of(line))
        for equation in EQUATIONS:
            if equation not in self.equations:
                self.fault(len(lines), f"equation {equation} has no row")

    def read_prose(self, number, line):
        self.paragraph = self.paragraph + [line] if line.strip() else []
        if line.startswith("#"):
            self.folders = {"Files": [], "Tests": []}
        text = " ".join(self.paragraph)
        if text.startswith("Files:"):
            files, _, tests = text.partition("Tests:")
            for kind, part in (("Files", files), ("Tests", tests)):
                self.folders[kind] = [path for code in CODE.findall(part) for path in expanded(code)]
        for code in CODE.findall(line):
            if code.startswith("placegraph "):
                self.commands.setdefault(code, number)
            elif "/" in code and " " not in code:
                for path in expanded(code):
                    if not os.path.exists(os.path.join(self.root, path)):
                        self.fault(number, f"no such file or folder: {path}")

    def read_row(self, number, cells):
        self.rows += 1
        if len(cells) != len(COLUMNS):
            self.fault(number, f"{len(cells)} cells, {len(COLUMNS)} are needed")
            return
        for column, cell in zip(COLUMNS, cells):
            if not re.search(r"\w", cell):
                self.fault(number, f"the column '{column}' is empty")
        item, _, file, command, test = cells
        self.equations.update(EQUATION.findall(item))
        if test.startswith("not built"):
            self.not_built += 1
            if not NOT_BUILT.match(test):
                self.fault(number, "'not built' without ', because ...'")
            if (file, command) != ("none", "none"):
                self.fault(number, "what is not built has the file 'none' and the command 'none'")
            return
        self.check_paths(number, "file", file, self.folders["Files"], FILE_ENDS)
        self.check_paths(number, "test", test, self.folders["Tests"], TEST_ENDS)
        self.check_command(number, command)

    def check_paths(self, number, column, cell, folders, ends):
        if cell and not CODE.search(cell):
            self.fault(number, f"the column '{column}' names nothing in backquotes")
        for name in CODE.findall(cell):
            found = paths_of(self.root, name, folders, ends)
            if not found:
                self.fault(number, f"no such {column}: {name}")
            elif len(found) > 1:
                self.fault(number, f"'{name}' may be {' or '.join(found)}")
            elif column == "test" and not found[0].startswith("tests/"):
                self.fault(number, f"not below tests/: {found[0]}")

    def check_command(self, number, cell):
        if cell == "library only":
            self.library_only += 1
        elif cell and not CODE.search(cell):
            self.fault(number, "the column 'command' names nothing in backquotes")
        for code in CODE.findall(cell):
            script = code.split()[0]
            if code.startswith("placegraph "):
                self.commands.setdefault(code, number)
            elif not ("/" in script and os.path.isfile(os.path.join(self.root, script))):
                self.fault(number, f"neither a command of placegraph nor a script: {code}")


def help_of(program, words):
    """Exit code and text of the help of some words."""
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True)
    return done.returncode, done.stdout


def command_fault(program, command):
    """What is wrong with a command, or nothing."""
    words = command.split()[1:]
    code, text = help_of(program, words)
    if code != 0:
        return f"`{command} --help` exits with {code}"
    if text == help_of(program, words[:-1])[1]:
        return f"no such command: {command}"
    return None


def main():
    root, program = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None
    with open(os.path.join(root, PAGE), encoding="utf-8") as text:
        lines = text.read().splitlines()
    page = Page(root)
    page.read(lines)
    if program:
        for command, number in page.commands.items():
            fault = command_fault(program, command)
            if fault:
                page.fault(number, fault)
    for number, fault in sorted(page.faults):
        print(f"{PAGE}:{number}: {fault}")
    if page.faults:
        return 1
    print(f"{PAGE}: {page.rows} rows, {page.not_built} not built, {page.library_only} in the library only, "
          f"{len(page.commands)} commands{'' if program else ' (not run)'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
