"""public_headers_selftest.py LINT: public_headers.py passes a clean tree and catches what is planted."""
import os
import subprocess
import sys
import tempfile

LINT = sys.argv[1]
OPEN = '\nnamespace [[gnu::visibility("default")]] placegraph {\n}\n'

# file: content; of the tree that has no fault
CLEAN = {
    "graph/map.h": "#include <Eigen/Core>\n#include <vector>\n#include <placegraph/graph/core/ids.h>\n" + OPEN,
    "graph/core/ids.h": OPEN,
    "graph/image/image.h": "#include <opencv2/core/mat.hpp>\n" + OPEN,
    "graph/map.cpp": "#include <placegraph/graph/core/tree.h>\nnamespace placegraph {\n}\n",
    "graph/core/tree.h": "#include <fmt/core.h>\nnamespace placegraph {\n}\n",
    "io/file.h": OPEN,
    "apps/main.cpp": "int main() {}\n",
    "apps/help.h": "namespace placegraph::apps {\n}\n",
    "cmake/public_headers.txt": "graph/core/ids.h\ngraph/image/image.h\ngraph/map.h\nio/file.h\n",
}
# What is planted: file, content, what the lint must say of it.
PLANTED = [
    ("cmake/public_headers.txt", "graph/core/ids.h\ngraph/image/image.h\ngraph/loop.h\ngraph/map.h\n",
     "cmake/public_headers.txt:3: graph/loop.h is no header of a library"),
    ("cmake/public_headers.txt", "graph/core/ids.h\ngraph/image/image.h\ngraph/map.cpp\n",
     "cmake/public_headers.txt:3: graph/map.cpp is no header of a library"),
    ("cmake/public_headers.txt", "apps/help.h\ngraph/core/ids.h\n",
     "cmake/public_headers.txt:1: apps/help.h is no header of a library"),
    ("cmake/public_headers.txt", "graph/image/image.h\ngraph/core/ids.h\n",
     "cmake/public_headers.txt:2: graph/core/ids.h stands behind graph/image/image.h"),
    ("io/file.h", "#include <placegraph/graph/core/tree.h>\n" + OPEN,
     "io/file.h:1: includes graph/core/tree.h, which is not installed"),
    ("io/file.h", "#include <fmt/core.h>\n" + OPEN, "io/file.h:1: fmt/core.h is no business"),
    ("io/file.h", "#include <opencv2/core/mat.hpp>\n" + OPEN, "io/file.h:1: opencv2/core/mat.hpp is no business"),
    ("io/file.h", "\nnamespace placegraph {\n}\n", "io/file.h:2: hidden by a shared library"),
    ("apps/main.cpp", "#include <placegraph/graph/core/tree.h>\n",
     "apps/main.cpp:1: includes graph/core/tree.h, which is not public"),
    ("python/src/map.cpp", "\n#include <placegraph/graph/core/tree.h>\n",
     "python/src/map.cpp:2: includes graph/core/tree.h, which is not public"),
]


def run(files):
    with tempfile.TemporaryDirectory() as root:
        for file, content in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, file)), exist_ok=True)
            with open(os.path.join(root, file), "w", encoding="utf-8") as out:
                out.write(content)
        done = subprocess.run([sys.executable, LINT, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


def listed(files):
    return files | {"cmake/public_headers.txt": "".join(f"{file}\n" for file in sorted(files))}


def chain(count):
    """A slam.h with so many headers behind it."""
    files = {f"graph/h{i}.h": f"#include <placegraph/graph/h{i + 1}.h>\n" + OPEN for i in range(count - 1)}
    files[f"graph/h{count - 1}.h"] = OPEN
    files["pipeline/slam.h"] = "#include <placegraph/graph/h0.h>\n" + OPEN
    return listed(files)


failures = []
code, said = run(CLEAN)
if code:
    failures.append(f"the clean tree is refused: {said}")
for name, text, expected in PLANTED:
    code, said = run(CLEAN | {name: text})
    if code != 1 or len(said.splitlines()) != 1 or expected not in said:
        failures.append(f"{name}: expected '{expected}', got {code}: {said}")
for count, expected in ((40, 0), (41, 1)):
    code, said = run(chain(count))
    if code != expected:
        failures.append(f"{count} headers behind slam.h: {code}: {said}")
for count, expected in ((315, 0), (316, 1)):
    code, said = run(listed({f"graph/h{i}.h": OPEN for i in range(count)}))
    if code != expected:
        failures.append(f"{count} public headers: {code}: {said}")
print("\n".join(failures) or f"public_headers.py: a clean tree passes, {len(PLANTED) + 2} planted faults are found")
sys.exit(1 if failures else 0)
