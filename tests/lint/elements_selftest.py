"""elements_selftest.py LINT: elements.py passes a clean page and catches planted faults."""
import os
import stat
import subprocess
import sys
import tempfile

HEAD = """# Elements

Files: `frontend/flow/`, `frontend/{lines,planes}/`.
Tests: `tests/unit/flow/`. Below is the first table; see `docs/results.md` and `placegraph run`.

| the thesis | our term | file | command | test |
|---|---|---|---|---|
"""
ROWS = "".join(f"| eq. 2.{number} | flow | `horn_schunck` | `placegraph image flow` | `flow` |\n"
               for number in range(1, 11))
TAIL = """| lines | edges | `tracker` | `placegraph track lines` | `tests/unit/lines/tracker_test` |
| planes | homography | `homography` | library only | `flow` |
| rate | basin | `frontend/flow/horn_schunck` | `scripts/results flow` | `flow` |
| SPRT | none | none | none | not built, because RANSAC is fast |
"""
FILES = {
    "docs/elements.md": HEAD + ROWS + TAIL,
    "docs/results.md": "",
    "frontend/flow/horn_schunck.h": "",
    "frontend/lines/tracker.cpp": "",
    "frontend/planes/homography.h": "",
    "scripts/results": "",
    "tests/unit/flow/flow_test.cpp": "",
    "tests/unit/lines/tracker_test.cpp": "",
}
# A program whose unknown words get the help of the group, as CLI11's do; `broken` fails.
PROGRAM = """#!/bin/sh
case "$*" in
  "image flow --help" | "track lines --help" | "run --help" | "image --help" | "track --help") echo "help of $*" ;;
  "image broken --help") exit 2 ;;
  "image "*" --help") echo "help of image --help" ;;
  "track "*" --help") echo "help of track --help" ;;
  *"--help") echo "help of all" ;;
esac
"""
LAST = (HEAD + ROWS + TAIL).count("\n")
# lines that are appended to the page, how many lines below its end the fault is, message
PLANTED = (
    ("| a | b | `horn` | `placegraph run` | `flow` |", 1, "no such file: horn"),
    ("| a | b | `frontend/flow/horn` | `placegraph run` | `flow` |", 1, "no such file: frontend/flow/horn"),
    ("| a | b | `tracker` | `placegraph run` | `tracker` |", 1, "no such test: tracker"),
    ("| a | b | `tracker` | `placegraph run` | `frontend/lines/tracker` |", 1,
     "not below tests/: frontend/lines/tracker"),
    ("| a | b | `tracker` | `placegraph image lines` | `flow` |", 1, "no such command: placegraph image lines"),
    ("| a | b | `tracker` | `placegraph flow` | `flow` |", 1, "no such command: placegraph flow"),
    ("| a | b | `tracker` | `placegraph image broken` | `flow` |", 1,
     "`placegraph image broken --help` exits with 2"),
    ("| a | b | `tracker` | `scripts/demo` | `flow` |", 1,
     "neither a command of placegraph nor a script: scripts/demo"),
    ("| a | b | `tracker` | run | `flow` |", 1, "the column 'command' names nothing in backquotes"),
    ("| a | b | none | `placegraph run` | `flow` |", 1, "the column 'file' names nothing in backquotes"),
    ("| a | b | `tracker` | `placegraph run` | none |", 1, "the column 'test' names nothing in backquotes"),
    ("| a |  | `tracker` | `placegraph run` | `flow` |", 1, "the column 'our term' is empty"),
    ("| a | - | `tracker` | `placegraph run` | `flow` |", 1, "the column 'our term' is empty"),
    ("| a | b | `tracker` |  | `flow` |", 1, "the column 'command' is empty"),
    ("| a | b | `tracker` | `placegraph run` |", 1, "4 cells, 5 are needed"),
    ("| a | none | none | none | not built |", 1, "'not built' without ', because ...'"),
    ("| a | none | `tracker` | none | not built, because it is slow |", 1,
     "what is not built has the file 'none' and the command 'none'"),
    ("\nSee `docs/result.md`.", 2, "no such file or folder: docs/result.md"),
    ("\nSee `placegraph hover`.", 2, "no such command: placegraph hover"),
    ("\n| the thesis | our term | file |\n|---|---|---|", 2,
     "a table has other columns than the thesis | our term | file | command | test"),
    ("\n## Lines\n\nFiles: `frontend/line/`.", 4, "no such file or folder: frontend/line/"),
    ("\n## Lines\n\n| the thesis | our term | file | command | test |\n|---|---|---|---|---|\n"
     "| a | b | `tracker` | `placegraph run` | `tests/unit/flow/flow` |", 6, "no such file: tracker"),
    ("\nFiles: `frontend/lines/`. Tests: `tests/unit/lines/`.\n\n| the thesis | our term | file | command | test |\n"
     "|---|---|---|---|---|\n| a | b | `homography` | `placegraph run` | `tracker` |", 6, "no such file: homography"),
)


def write_tree(root, page):
    for name, text in {**FILES, "docs/elements.md": page}.items():
        path = os.path.join(root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
    program = os.path.join(root, "program")
    with open(program, "w", encoding="utf-8") as out:
        out.write(PROGRAM)
    os.chmod(program, stat.S_IRWXU)
    return program


def lint(script, page, with_program=True, extra=()):
    with tempfile.TemporaryDirectory() as root:
        program = write_tree(root, page)
        for path in extra:
            with open(os.path.join(root, path), "w", encoding="utf-8"):
                pass
        done = subprocess.run([sys.executable, script, root] + [program] * with_program, capture_output=True, text=True)
    return done.returncode, (done.stdout + done.stderr).strip()


def main():
    script, failures = os.path.abspath(sys.argv[1]), 0
    clean = FILES["docs/elements.md"]
    counts = "docs/elements.md: 14 rows, 1 not built, 1 in the library only, 3 commands"
    cases = [("the clean page", lint(script, clean), (0, counts)),
             ("the clean page without a program", lint(script, clean, False), (0, counts + " (not run)"))]
    for lines, below, message in PLANTED:
        cases.append((lines, lint(script, clean + lines + "\n"), (1, f"docs/elements.md:{LAST + below}: {message}")))
    for number in (1, 10):
        page = clean.replace(f"| eq. 2.{number} |", "| an equation |")
        cases.append((f"no eq. 2.{number}", lint(script, page),
                      (1, f"docs/elements.md:{LAST}: equation 2.{number} has no row")))
    twice = lint(script, clean, True, ("frontend/flow/tracker.h",))
    line = clean[:clean.index("| lines |")].count("\n") + 1
    cases.append(("a name in two folders", twice,
                  (1, f"docs/elements.md:{line}: 'tracker' may be frontend/flow/tracker or frontend/lines/tracker")))
    for name, result, expected in cases:
        if result != expected:
            print(f"{name}: {result}, not {expected}")
            failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
