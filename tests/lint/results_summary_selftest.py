#!/usr/bin/env python3
"""What `scripts/results --summary` reads from pages, and that --check finds what is planted."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "scripts" / "results.d" / "summary.py"

TOWN = """# Town

| sequence | figure | target | measured | met |
|---|---|---|---|---|
| town, mono | ATE [m] | <= 0.5 | 0.40 | yes |
| town, mono | loops | >= 3 | 2 of 4 | **no** |
| town, stereo | ATE [m] | - | 0.044 / 0.016 | - |

## Times

| graph | limit | CPU | in time | lost |
|---|---|---|---|---|
| a | 29 | 21.0 | yes | 0 of 9 |
| b | 29 | 30.5 | **no** | 1 of 9 |
"""
ROWS = """## Drives
ATE of the town [m] | town | town, mono, ATE [m] | measured | target | ORB-SLAM2 0.6 | PEERS 4
loops | town | town, mono, loops | measured | target | - | -
with loops [m] | town | town, stereo, ATE [m] | measured#2 | - | - | -
"""


class Summary(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "docs" / "results").mkdir(parents=True)
        self.write("docs/results/town.md", TOWN)
        self.write("rows.txt", ROWS)

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def run_program(self, *arguments):
        done = subprocess.run([sys.executable, "-B", PROGRAM, self.root, "--rows", self.root / "rows.txt", *arguments],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def page_of(self, rows):
        self.write("rows.txt", rows)
        self.assertEqual(self.run_program(), (0, ""))
        return (self.root / "docs" / "results.md").read_text(encoding="utf-8")

    def test_rows_are_those_of_the_pages(self):
        page = self.page_of(ROWS)
        self.assertIn("| ATE of the town [m] | 0.40 | <= 0.5 | yes | ORB-SLAM2 0.6 | [town] |", page)
        self.assertIn("| loops | 2 of 4 | >= 3 | **no** | - | [town] |", page)
        self.assertIn("| with loops [m] | 0.016 | - | - | - | [town] |", page)
        self.assertIn("4 targets: 2 are met, 2 are missed. Missed by page:\n[town] 2.", page)
        self.assertIn("\n[town]: results/town.md\n", page)
        self.assertEqual(self.run_program("--check")[0], 0)

    def test_functions_over_rows(self):
        for rows, line in (("x | town | * | max: CPU | \"<= 30\" | - | -", "| x | 30.5 | <= 30 | **no** |"),
                           ("x | town | * | min: CPU | \"<= 30\" | - | -", "| x | 21.0 | <= 30 | yes |"),
                           ("x | town | * | sum: lost | \"= 0\" | - | -", "| x | 1 | = 0 | **no** |"),
                           ("x | town | * | met: in time | \"all\" | - | -", "| x | 1 of 2 | all | **no** |"),
                           ("x | town | a | CPU | limit; in time | - | -", "| x | 21.0 | 29 | yes |"),
                           ("x | town: Ti* | b | CPU | in time | - | -", "| x | 30.5 | in time | **no** |")):
            self.assertIn(line, self.page_of("## Group\n" + rows))

    def test_check_finds_what_is_planted_and_writes_nothing(self):
        page = self.page_of(ROWS)
        for text in (page.replace("0.40", "0.04"), page.replace("2 are met", "3 are met"), page + "\n"):
            self.write("docs/results.md", text)
            code, told = self.run_program("--check")
            self.assertEqual((code, "not what its pages say" in told), (1, True), told)
            self.assertEqual((self.root / "docs" / "results.md").read_text(encoding="utf-8"), text)
        self.write("docs/results.md", page)
        self.write("docs/results/town.md", TOWN.replace("0.40", "0.41"))
        self.assertEqual(self.run_program("--check")[0], 1)
        (self.root / "docs" / "results.md").unlink()
        self.assertEqual(self.run_program("--check")[0], 1)

    def test_what_cannot_be_found_is_refused_in_one_line(self):
        self.assertEqual(self.run_program()[0], 0)
        many = "## Group\n" + "x | town | a | CPU | - | - | -\n" * 61
        for rows, part in (("## Group\nx | city | a | CPU | - | - | -", "rows.txt:2: there is no page city"),
                           ("## Group\nx | town | c | CPU | - | - | -", "rows.txt:2: 'c | CPU' is in 0 tables"),
                           ("## Group\nx | town | a | GPU | - | - | -", "rows.txt:2: 'a | GPU' is in 0 tables"),
                           ("## Group\nx | town | * | CPU | - | - | -", "rows.txt:2: '*' fits 2 rows"),
                           ("## Group\nx | town | a | CPU#2 | - | - | -", "no figure"),
                           ("## Group\nx | town | a | CPU | target | - | -", "has no column 'target'"),
                           ("## Group\nx | town | a | CPU | \"below 5\" | - | -", "is no limit"),
                           ("## Group\nx | town | a | CPU | - | ORB-SLAM2 1 | -", "has a source"),
                           ("## Group\nx | town | a | CPU | - | -", "rows.txt:2: a line"),
                           ("x | town | a | CPU | - | - | -", "rows.txt:1: a line"),
                           (many, "61 rows, 60 are allowed")):
            self.write("rows.txt", rows)
            for arguments in ((), ("--check",)):
                code, told = self.run_program(*arguments)
                self.assertEqual((code, len(told.splitlines())), (2, 1), told)
                self.assertIn(part, told)
        self.write("rows.txt", ROWS)
        self.write("docs/results/town.md", TOWN + "| c |\n")
        self.assertIn("town.md:15: 1 cells", self.run_program("--check")[1])


if __name__ == "__main__":
    unittest.main()
