"""prose_selftest.py PROSE: prose.py finds what is planted and leaves the rest alone."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SENTENCE = "/// Does a thing.\n"
PLANTED = [  # file, text, the line of the fault or None
    ("graph/a.h", SENTENCE + "struct A {};\n", None),
    ("graph/a.h", "struct A {};\n", 1),
    ("graph/a.h", "/// Begins no sentence\nint f();\n", 2),
    ("graph/a.h", "/// " + 90 * "x" + ".\nint f();\n", 2),
    ("graph/a.h", SENTENCE + "template <typename T>\nT f(const T& x,\n    int y);\n\nclass B;\n", None),
    ("graph/a.h", "int a = 0;  // what the eye sees\n", 1),
    ("graph/b.h", "struct A {};\n", None),  # not public
    ("graph/a.cpp", 'void f() { fail("no\tsight of it"); }\n', 1),
    ("graph/a.cpp", '#include "eye.h"\nint eye = at["sight"];  // log odds, `eye`\n', None),
    ("docs/a.md", "The camera.\n\nTwo eyes see\nmore.\n", 3),
    ("docs/a.md", "The free\nunits of a map.\n", 1),
    ("docs/a.md", "`eye` and\n\n```\ntwo eyes\n```\n", None),
    ("docs/elements.md", "One eye.\n", None),
    ("README.md", "Places are believed.\n", 1),
]

failures = 0
for file, text, line in PLANTED:
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for path in ("tests/lint/words.txt", "README.md", file):
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).touch()
        shutil.copy(pathlib.Path(sys.argv[1]).with_name("words.txt"), root / "tests/lint/words.txt")
        (root / file).write_text(text)
        (root / "cmake").mkdir()
        (root / "cmake/public_headers.txt").write_text("graph/a.h\n" if file == "graph/a.h" else "")
        run = subprocess.run([sys.executable, sys.argv[1], folder], capture_output=True, text=True)
        found = [fault.split(":")[:2] for fault in run.stdout.splitlines() if run.returncode]
        if found != ([[file, str(line)]] if line else []):
            failures += 1
            print(f"{file}: {text!r}: {run.stdout}{run.stderr}")
sys.exit(1 if failures else 0)
