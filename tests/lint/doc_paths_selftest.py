"""doc_paths_selftest.py LINT: doc_paths.py passes a clean tree and catches planted faults."""
import os
import subprocess
import sys
import tempfile

FILES = {
    "README.md": "See `io/graphs/`, [maps](docs/map.md#saved-maps), not [it](https://a.b/c.md).\n"
                 "```cpp\n#include <placegraph/io/graphs/g2o.h>\nfor a in io/graphs/*.h\n```\n",
    "docs/map.md": "# Saved maps\n\nTwo lines of `frontend\n  places`, `io/graphs/g2o`, `g2o.h`,\n"
                   "`io/<name>`, `io/graphs/{g2o,\n  toro}.h`, docs/map.md, [above](#saved-maps),\n"
                   "[home](../README.md), `G2o::read`.\n",
    "io/graphs/g2o.h": "struct G2o { void read(); };",
    "io/graphs/toro.h": "",
    "scripts/demo": "",
}
# file, line that is appended to it, message
PLANTED = (
    ("README.md", "See `io/files/`.", "no such file or folder: io/files/"),
    ("README.md", "See `scripts/demos`.", "no such file or folder: scripts/demos"),
    ("README.md", "See `io/graphs/toro.cpp`.", "no such file or folder: io/graphs/toro.cpp"),
    ("README.md", "See `io/graphs/{g2o,isam}.h`.", "no such file or folder: io/graphs/isam.h"),
    ("README.md", "See `io/graphs/*.txt`.", "no such file or folder: io/graphs/*.txt"),
    ("README.md", "See `eval/<name>`.", "no such file or folder: eval/<name>"),
    ("README.md", "See `G2o::write`.", "no such name in the sources: write"),
    ("README.md", "See `isam.h`.", "no such file or folder: isam.h"),
    ("README.md", "See `#include <placegraph/io/isam.h>`.", "no such file or folder: io/isam.h"),
    ("README.md", "See [it](docs/maps.md).", "the link leads nowhere: docs/maps.md"),
    ("README.md", "See ![it](map.png).", "the link leads nowhere: map.png"),
    ("README.md", "See [it](docs/map.md#a-map).", "no heading of this name: docs/map.md#a-map"),
    ("docs/map.md", "See docs/maps.md.", "no such file or folder: docs/maps.md"),
    ("docs/map.md", "See [it](docs/map.md).", "the link leads nowhere: docs/map.md"),
    ("docs/map.md", "See [it](#a-map).", "no heading of this name: #a-map"),
    ("docs/map.md", "[it]: maps.md", "the link leads nowhere: maps.md"),
    ("docs/map.md", "word " * 24 + "x", "a line of 121 characters, 120 are allowed"),
    ("README.md", "| " + "a" * 118 + " |", "a line of 122 characters, 120 are allowed"),
    ("docs/results/town.md", "    " + "word " * 25, "a line of 129 characters, 120 are allowed"),
    ("docs/studies/a.md", "Run `scripts/demos` twice.", "no such file or folder: scripts/demos"),
    ("CHANGELOG.md", "Run `scripts/demos` twice.", "no such file or folder: scripts/demos"),
)


def write_tree(root):
    for name, text in FILES.items():
        path = os.path.join(root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)


def lint(script, root):
    done = subprocess.run([sys.executable, script, root], capture_output=True, text=True)
    return done.returncode, (done.stdout + done.stderr).strip()


def main():
    script, failures = os.path.abspath(sys.argv[1]), 0
    for file, line, message in (("", "", ""),) + PLANTED:
        with tempfile.TemporaryDirectory() as root:
            write_tree(root)
            expected = (0, "")
            if file:
                path = os.path.join(root, file)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "a+", encoding="utf-8") as out:
                    out.write(line + "\n")
                    out.seek(0)
                    number = out.read().count("\n")
                expected = (1, f"{file}:{number}: {message}")
            result = lint(script, root)
            if result != expected:
                print(f"{file or 'the clean tree'}: {line}: {result}, not {expected}")
                failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
