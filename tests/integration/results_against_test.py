#!/usr/bin/env python3
"""What `scripts/results --against` and `--compare` take for better, worse and gone, on small files.

results_against_test.py PLACEGRAPH
"""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "scripts" / "results.d" / "against.py"
GATE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROGRAM.parent))

import against  # noqa: E402
import tables  # noqa: E402

RULES = """# a comment
* | time | time
* | seen | info
* | mixed#1 | lower 2 %
* | mixed#2 | higher 0.01
* | doors | higher 0
* | places | higher 1 % whole
* | ATE [m] | lower 2 %
* | recall | higher 1 % 0.002
* | * | equal 0.1 %
"""
WORDS = {"regressed": "worse", "improved": "better", "within the rule": "same", "for information": "info"}
MARK = "<!-- section: town -->\n\n"
PAGE = "# Town\n\n    a command\n\n| row | ATE [m] |\n|---|---|\n| a | 1.00 |\n\n## Second\n\n| row | x |\n|---|---|\n| b | 1 |\n"

# Column, before, {after: verdicts of the figures of the cell, the worst first}.
CELLS = [
    ("ATE [m]", "1.000", {"0.970": "better", "1.020": "same", "1.0201": "worse"}), ("ATE [m]", "0", {"0.1": "worse", "0": "same"}),
    ("ATE [m]", "0.1", {"0": "better"}), ("ATE [m]", "-1.00", {"-1.50": "better", "-0.50": "worse"}),
    *[("ATE [m]", lost, {"1.5": "new", lost: "same"}) for lost in ("none", "-", "", "nan")],
    ("recall", "0.900", {"0.920": "better"}), ("recall", "0.100", {"0.098": "same", "0.0979": "worse"}),
    ("unknown", "100", {"101": "worse", "99": "worse", "100.1": "same"}),
    ("time", "1", {"9": "info"}), ("seen", "9", {"1": "info"}), ("seen", "chordal", {"file": "info"}),
    # A figure or a verdict that is lost is worse under every rule.
    *[(column, "1.5", dict.fromkeys(("nan", "-nan", "none", "-", "", "no answer", "inf"), "worse")) for column in ("ATE [m]", "recall", "seen", "time", "x")],
    *[(column, "yes", {"**no**": "worse", "-": "worse", "yes": "same"}) for column in ("met", "seen", "time", "ATE [m]")],
    *[(column, "**no**", {"yes": "better"}) for column in ("met", "seen", "time", "ATE [m]")],
    # Several figures in a cell, fractions, targets, text.
    ("mixed", ".5 cm .900 23/24", {".6 cm .986 22/24": "worse worse better"}), ("mixed", "1.0", {"1.0 (130)": "worse new new"}),
    ("mixed", "1.0 / 2.0", {"1.0": "worse worse new", "none": "worse worse new"}), ("doors", "3 of 3", {"2 of 2": "worse"}),
    ("doors", "22/24", {"21/24": "worse", "23 of 24": "better"}), ("places", "30 of 30", {"32 of 32": "same", "30 of 32": "worse"}),
    ("met", "length >= 20: yes; wrong <= 1 %: yes", {"length >= 20: **no**; wrong <= 1 %: yes": "worse same same same"}),
    ("target", "<= 5", {"<= 6": "worse", ">= 5": "worse"}), ("kept", "chordal", {"file": "worse", "chordal": "same"}),
]
ONE, TWO = "row | x\na | 1", "row | x\na | 1\nb | 2"
WIDE = "row | x | target | met | y | target | met\na | 1 | <= 2 | yes | 3 | <= 4 | yes"
PARTS = "row | x | target | met\na | 1 | <= 2 | yes\n\nrow | y | target | met\na | 3 | <= 4 | yes"
ALL_OF_WIDE = "a/x=same; a/target (x)=same; a/met (x)=same; a/y=same; a/target (y)=same; a/met (y)=same"
# What happens to rows, columns and tables: before, after, rules, ROW/COLUMN=VERDICT of every figure.
TABLES = [
    (ONE, "row | x\na | 1.000001", "", "a/x=worse"),
    (TWO, "row | x\na | 1\nc | 2", "", "a/x=same; b/=worse; c/=new"),
    ("row | x\nb | 2", "row | x\nc | 3", "rename town/b -> town/c\n* | * | lower 0", "c/x=worse"),
    ("row | x\nb | 2", "row | x\nc | 3", "rename town/b -> town/c\ntown/c | x | info", "c/x=info"),
    ("row | x\nb | 2", "row | x\nd | 2", "rename town/b -> town/c", "c/=worse; d/=new"),
    (TWO, ONE, "rename town/b -> (gone)", "a/x=same"),
    ("row | x\na, one eye, 7 | 2", "row | x\na, mono, 7 | 3", "rename *, one eye, * -> *, mono, *", "a, mono, 7/x=worse"),
    ("row | x | y\na | 1 | 2", "row | x | z\na | 1 | 2", "", "a/x=same; a/y=worse; a/z=new"),
    ("row | x | y\na | 1 | 2", "row | x | z\na | 1 | 2", "rename town/* | y -> z", "a/x=same; a/z=same"),
    # A row is named by as many cells as are needed, in both versions.
    ("graph | cost | x\na | g2o | 1\na | log | 2", "graph | cost | x\na | log | 2\na | g2o | 3", "", "a, g2o/x=worse; a, log/x=same"),
    ("graph | cost | x\na | g2o | 1", "graph | cost | x\na | g2o | 1\na | log | 2", "", "a, g2o/x=same; a, log/=new"),
    # A wide table may be written as several with the same first column.
    (WIDE, PARTS, "", ALL_OF_WIDE), (PARTS, WIDE, "", ALL_OF_WIDE), (PARTS, PARTS, "", ALL_OF_WIDE),
    (WIDE, PARTS.replace("3 | <= 4", "5 | <= 4"), "", ALL_OF_WIDE.replace("y=same", "y=worse")),
    (WIDE, PARTS.split("\n\n")[0], "", "a/x=same; a/target (x)=same; a/met (x)=same; a/y=worse; a/target (y)=worse; a/met (y)=worse"),
    *[(ONE, ONE + "\n\n" + second, "", "a/x=same; " + new) for second, new in (
        ("row | x | z\na | 2 | 3", "a no. 2/=new"), ("row | z\nb | 3", "b/=new"), ("row | z\na | 3\nb | 4", "a/z=new; b/=new"))],
    # What the first column is called does not name a row.
    (ONE, "other | x\na | 1", "", "a/x=same"),
]


def file_of(text, heading="Town", section="town", foot=""):
    """A single file; tables are separated by an empty line, cells by bars."""
    lines = [f"<!-- section: {section} -->", "", f"### {heading}"]
    for table in text.split("\n\n"):
        head, *rows = table.split("\n")
        lines += ["", f"| {head} |", "|" + "---|" * (head.count("|") + 1), *(f"| {row} |" for row in rows)]
    return "\n".join(lines + ["", foot, ""])


def compared(before, after, text=RULES):
    """{section: [(row, column, verdict)]} of all figures, the worst first."""
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder, name) for name in ("before.json", "after.json", "rules.txt")]
        old, new = tables.parse(before, "before"), tables.parse(after, "after")
        against.write_records(old, new, list(old) + [name for name in new if name not in old], ("old", "new"), files[:2])
        files[2].write_text(text, encoding="utf-8")
        done = subprocess.run([GATE, "eval", "gate", *files[:2], "--rules", files[2], "--json"], capture_output=True, text=True, check=False)
    sections = collections.defaultdict(list)
    for figure in json.loads(done.stdout)["figures"]:
        section, _, row = figure["sequence"].partition("/")
        sections[section].append((row, figure["figure"], WORDS.get(figure["verdict"], figure["verdict"]), figure["change"]))
    return sections


class Comparison(unittest.TestCase):
    def test_cells(self):
        cases = [(column, before, after, wanted) for column, before, rest in CELLS for after, wanted in rest.items()]
        files = ["".join(file_of(f"row | {case[0]}\na | {case[side]}", section=f"case{number}") for number, case in enumerate(cases))
                 for side in (1, 2)]
        told = compared(*files)
        for number, case in enumerate(cases):
            self.assertEqual(" ".join(line[2] for line in told[f"case{number}"]), case[3], case)
        self.assertEqual([figure.value for figure in tables.figures_of("kitti_00 M3500 -4.3e-15 R@1 (2.4 %)")[0]], [-4.3e-15, 2.4])

    def test_rows_columns_and_tables(self):
        for before, after, text, wanted in TABLES:
            lines = compared(file_of(before), file_of(after), text)["town"]
            self.assertEqual(sorted(f"{row}/{column}={verdict}" for row, column, verdict, _ in lines), sorted(wanted.split("; ")), (before, after))

    def test_sections(self):
        failed = MARK + "### town\n\n**no**: failed, see `out`.\n"
        for after, text, wanted in ((file_of(ONE, section="city"), "", {"town": "worse", "city": "new"}), (failed, "", {"town": "worse"}),
                                    (file_of(ONE, section="city"), "rename town/* -> city/*", {"city": "same"}),
                                    (file_of(ONE, heading="Another"), "", {"town": "same"})):
            told = compared(file_of(ONE), after, text)
            self.assertEqual({name: " ".join(line[2] for line in lines) for name, lines in told.items()}, wanted, after)
        apart = file_of(ONE) + file_of("row | z\na | 1", heading="Another").replace(MARK, "")
        self.assertEqual(len(tables.joined_tables(tables.parse(apart, "apart")["town"].tables)), 2)

    def test_times_are_told_by_their_reference_runs(self):
        foot = "Measured at 1 on 2 cores (X); reference run {} s (1 before, 1 after)."
        told = compared(file_of("row | time\na | 1.0", foot=foot.format("0.200")), file_of("row | time\na | 2.2", foot=foot.format("0.400")))
        self.assertEqual(told["town"], [("a", "time", "info", "+120 % (+10 % by the reference runs)")])


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return str(path)

    def pages(self, folder, **texts):
        return str(pathlib.Path([self.file(f"{folder}/{name}.md", text) for name, text in texts.items()][0]).parent)

    def told(self, wanted, *arguments, program=PROGRAM):
        gate = ["--program", GATE] if arguments[0] == "compare" else []
        done = subprocess.run([sys.executable, "-B", program, *arguments, *gate], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (wanted, int(wanted == 2)), (arguments, done.stdout, done.stderr))
        return done.stdout + done.stderr

    def test_exit_codes_and_lines(self):
        before, after = (self.file(f"{a}.md", file_of(f"row | ATE [m]\na | {a}\nb | {b}")) for a, b in (("1.00", "1.00"), ("2.00", "1.01")))
        tolerances = ("--tolerances", self.file("t.txt", RULES))
        self.assertIn("2 figures: 2 same.", self.told(0, "compare", before, before, *tolerances))
        told = self.told(1, "compare", before, after, "town", *tolerances)
        self.assertRegex(told, r"regressed +town/a +ATE \[m\] +1 +2 +\+100 % +lower 2 %")
        self.assertRegex(told, r"within the rule +town/b +ATE \[m\] +1 +1.01 +\+1 % +lower 2 %")

    def test_folders_single_files_and_git_revisions_are_read_alike(self):
        folder, single, project = self.pages("pages", town=PAGE), self.file("single.md", MARK + PAGE), self.folder / "project"
        other = self.pages("other", town=PAGE.replace("1.00", "2.00"), city=PAGE)
        kept = self.file("kept.md", self.told(0, "fetch", other, "city"))  # the form of a baseline
        for source in PROGRAM.parent.glob("*.[pt][yx]*"):
            self.file(f"project/scripts/results.d/{source.name}", source.read_bytes())
        program = project / "scripts/results.d/against.py"
        for name, text in (("pages", PAGE), ("ragged", PAGE + "| c |\n")):
            self.file("project/docs/results/town.md", text)
            for command in (("init", "-q"), ("add", "docs"), ("commit", "-qm", name), ("tag", name)):
                subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false", *command], cwd=project, check=True)
        for before, after in ((single, folder), (folder, single), (folder, folder), (kept, other), ("pages", folder), (folder, "pages")):
            count = 4 if before == kept else 2
            self.assertIn(f"{count} figures: {count} same.", self.told(0, "compare", before, after, program=program))
        self.assertRegex(self.told(1, "compare", single, other), r"regressed +town/a +ATE \[m\] +1 +2 +\+100 %")
        self.assertIn("city/a: the candidate lacks the sequence.", self.told(1, "compare", other, folder))
        self.assertIn("ragged:docs/results/town.md:14: 1 cells where", self.told(2, "compare", "pages", "ragged", program=program))

    def test_what_cannot_be_compared_is_refused_in_one_line(self):
        good, ragged = self.pages("good", town=PAGE), self.pages("ragged", town=PAGE, zebra=PAGE + "| c | 2 | 3 |\n")
        (self.folder / "empty").mkdir()
        for text, part in (("", "no section of results"), ("<!-- section: a -->\n| b | c\n", "does not end"),
                           ("<!-- section: a -->\n| b | c |\n", "dashes"), (file_of(ONE) + file_of(ONE), "second section")):
            self.assertIn(part, self.told(2, "fetch", self.file("single.md", text)))
        for text in ("a | lower 2 %", "a | b | less 2 %", "a | b | lower x %", "rename a b", "a | b | lower -2 %", "a | b | lower nan"):
            self.assertIn("t.txt:1", self.told(2, "compare", good, good, "--tolerances", self.file("t.txt", text)), text)
        for part, *arguments in (("ragged/zebra.md:14: 3 cells where the head has 2", "compare", ragged, good), ("ragged/zebra.md:14:", "fetch", ragged),
                                 ("bare/town.md:1: a page of results begins", "fetch", self.pages("bare", town="| row | x |\n|---|---|\n| a | 1 |\n")),
                                 ("cannot be read", "fetch", self.pages("latin", town=b"# Town \xff\n")),
                                 ("no page of results", "fetch", str(self.folder / "empty")), ("neither", "compare", good, good + "/nowhere"),
                                 ("neither", "compare", good, "no-such-revision"), ("no section city", "fetch", good, "city"),
                                 ("section city", "compare", good, good, "city")):
            self.assertIn(part, self.told(2, *arguments), arguments)

    def test_the_results_of_the_project_are_read_to_the_last_figure(self):
        results = str(ROOT / "docs" / "results")
        self.assertNotIn("regressed", self.told(0, "compare", results, results, "--all"))


if __name__ == "__main__":
    unittest.main()
