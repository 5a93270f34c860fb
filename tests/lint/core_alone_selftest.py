"""core_alone_selftest.py LINT: core_alone.py passes a clean tree and catches what is planted."""
import os
import subprocess
import sys
import tempfile

LINT = sys.argv[1]

# file: content; of the tree that has no fault
CLEAN = {
    **{f"{layer}/CMakeLists.txt": "" for layer in ("graph", "backend", "io", "eval", "pipeline")},
    "frontend/CMakeLists.txt": "placegraph_library(frontend\n  SOURCES a.cpp)\n"
                               "placegraph_elements(\n  plan/room.cpp plan/door.cpp)\n",
    "frontend/a.cpp": "#include <placegraph/frontend/a.h>\n",
    "frontend/a.h": "#include <placegraph/graph/b.h>\n",
    "graph/b.h": "",
    "frontend/plan/room.cpp": "#include <placegraph/frontend/plan/room.h>\n",
    "frontend/plan/room.h": "#include <placegraph/frontend/plan/area.h>\n",
    "frontend/plan/area.h": "#include <placegraph/frontend/plan/door.h>\n",
    "frontend/plan/door.cpp": "#include <placegraph/frontend/plan/door.h>\n",
    "frontend/plan/door.h": "#include <placegraph/frontend/a.h>\n",
    "apps/plan.cpp": "#include <placegraph/frontend/plan/room.h>\n",
}
# What is planted: file, content, what the lint must say of it.
PLANTED = [
    ("frontend/a.cpp", "#include <placegraph/frontend/plan/room.h>\n",
     "frontend/a.cpp:1: frontend/plan/room.h belongs to placegraph::elements"),
    ("graph/b.h", "\n#include <placegraph/frontend/plan/area.h>\n",
     "frontend/plan/area.h:1: frontend/plan/door.h belongs to placegraph::elements"),
    ("pipeline/new.cpp", "#include <placegraph/frontend/plan/door.h>\n",
     "pipeline/new.cpp:1: frontend/plan/door.h belongs to placegraph::elements"),
    ("io/CMakeLists.txt", "\nplacegraph_elements(gone.cpp)\n", "io/CMakeLists.txt:2: no source io/gone.cpp"),
]


def run(files):
    with tempfile.TemporaryDirectory() as root:
        for file, content in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, file)), exist_ok=True)
            with open(os.path.join(root, file), "w", encoding="utf-8") as out:
                out.write(content)
        done = subprocess.run([sys.executable, LINT, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


code, said = run(CLEAN)
if code != 0:
    sys.exit(f"a clean tree is faulted:\n{said}")
for planted, text, expected in PLANTED:
    code, said = run(CLEAN | {planted: text})
    if code != 1 or expected not in said:
        sys.exit(f"{planted} with {text!r}: expected {expected!r}, the lint says (exit code {code}):\n{said}")
print(f"core_alone_selftest: {len(PLANTED)} planted faults were found")
