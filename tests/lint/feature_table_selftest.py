"""feature_table_selftest.py LINT: feature_table.py passes a sound table and catches planted faults."""
import os
import subprocess
import sys
import tempfile

HEAD = "## Other\n\n| a | b |\n|---|---|\n| x | `none.cpp` |\n\n### Beside other tools\n\n| feature | ours | evo | test |\n|---|---|---|---|\n"
SOUND = ("| Gaps | yes | no | `gap_test.cpp` `NeverCrossed` |\n| Bags | Python | yes | `test_bag.py` |\n"
         "| Excel | no | yes | - |\n")
# row, message
PLANTED = (
    ("| Gaps | yes | no | `gaps_test.cpp` |", "no such test: `gaps_test.cpp`"),
    ("| Gaps | yes | no | gap_test.cpp |", "no such test: gap_test.cpp"),
    ("| Gaps | yes | no | `gap_test.cpp` `Crossed` `Often` |", "gap_test.cpp has no Often"),
    ("| Gaps | yes | no | - |", "no test"),
    ("| Gaps | yes | `gap_test.cpp` |", "3 cells, the head has 4"),
    ("| Gaps | yes |  | `gap_test.cpp` |", "3 cells, the head has 4"),
)


def lint(script, table):
    with tempfile.TemporaryDirectory() as root:
        for name, text in (("docs/evaluation.md", table), ("python/tests/test_bag.py", ""),
                           ("tests/unit/gap_test.cpp", "TEST(Gap, NeverCrossed)")):
            os.makedirs(os.path.dirname(os.path.join(root, name)), exist_ok=True)
            with open(os.path.join(root, name), "w", encoding="utf-8") as out:
                out.write(text)
        done = subprocess.run([sys.executable, script, root], capture_output=True, text=True)
        return done.returncode, (done.stdout + done.stderr).strip()


def main():
    script, failures = os.path.abspath(sys.argv[1]), 0
    cases = [(HEAD + SOUND + "\n## Loops\n\n| a | b |\n", (0, ""))]
    cases += [(HEAD + SOUND + row + "\n", (1, f"docs/evaluation.md:14: {message}")) for row, message in PLANTED]
    cases += [("## Loops\n", (1, "docs/evaluation.md: no table below 'Beside other tools'")),
              (HEAD, (1, "docs/evaluation.md: no table below 'Beside other tools'"))]
    for table, expected in cases:
        result = lint(script, table)
        if result != expected:
            print(f"{table}: {result}, not {expected}")
            failures += 1
    return 1 if failures else 0


sys.exit(main())
