#!/usr/bin/env python3
"""What `scripts/results --against` and `--compare` take for better, worse and gone, on small files."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "scripts" / "results.d" / "against.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROGRAM.parent))

import against  # noqa: E402
import rules  # noqa: E402
import tables  # noqa: E402

RULES = """
# a comment
town | * | time | time
town | * | seen | info
town | * | mixed#1 | lower 2 %
town | * | mixed#2 | higher 0.01
town | * | doors | higher 0
town | * | places | higher 1 % whole
town | * | ATE [m] | lower 2 %
town | * | recall | higher 1 % 0.002
* | * | * | equal 0.1 %
"""


def file_of(columns, *rows, section="town", foot="", heading="Town"):
    lines = [f"<!-- section: {section} -->", "", f"### {heading}", "", f"| {' | '.join(columns)} |",
             "|" + "---|" * len(columns)]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows] + ["", foot, ""])


def compared(before, after, text=RULES, chosen=()):
    old, new = tables.parse(before, "before"), tables.parse(after, "after")
    return against.compare(old, new, rules.parse_rules(text, "rules"), chosen)


def verdicts(column, before, after, text=RULES):
    """Verdicts of one cell in one row."""
    lines = compared(file_of(("row", column), ("a", before)), file_of(("row", column), ("a", after)), text)
    return [line.judgement.verdict for line in lines]


class Numbers(unittest.TestCase):
    def test_less_is_better_where_it_is_said(self):
        self.assertEqual(verdicts("ATE [m]", "1.000", "1.030"), ["worse"])
        self.assertEqual(verdicts("ATE [m]", "1.000", "0.970"), ["better"])
        self.assertEqual(verdicts("ATE [m]", "1.000", "1.010"), ["same"])

    def test_more_is_better_where_it_is_said(self):
        self.assertEqual(verdicts("recall", "0.900", "0.880"), ["worse"])
        self.assertEqual(verdicts("recall", "0.900", "0.920"), ["better"])

    def test_a_change_of_exactly_the_tolerance_passes(self):
        self.assertEqual(verdicts("ATE [m]", "1.000", "1.020"), ["same"])
        self.assertEqual(verdicts("ATE [m]", "1.000", "1.0201"), ["worse"])
        self.assertEqual(verdicts("recall", "0.100", "0.098"), ["same"])
        self.assertEqual(verdicts("recall", "0.100", "0.0979"), ["worse"])

    def test_an_unknown_figure_does_not_pass_in_either_direction(self):
        self.assertEqual(verdicts("never heard of", "100", "101"), ["worse"])
        self.assertEqual(verdicts("never heard of", "100", "99"), ["worse"])
        self.assertEqual(verdicts("never heard of", "10000", "10001"), ["same"])

    def test_without_any_rule_nothing_may_change(self):
        self.assertEqual(verdicts("x", "1000000", "1000001", ""), ["worse"])

    def test_from_and_to_nothing(self):
        self.assertEqual(verdicts("ATE [m]", "0", "0.1"), ["worse"])
        self.assertEqual(verdicts("ATE [m]", "0", "0"), ["same"])
        self.assertEqual(verdicts("ATE [m]", "0.1", "0"), ["better"])

    def test_negative_ones(self):
        self.assertEqual(verdicts("ATE [m]", "-1.00", "-1.50"), ["better"])
        self.assertEqual(verdicts("ATE [m]", "-1.00", "-0.50"), ["worse"])

    def test_not_a_number_and_none_are_worse_under_every_rule(self):
        for after in ("nan", "-nan", "none", "-", "", "no answer", "inf"):
            for column in ("ATE [m]", "recall", "seen", "time", "x"):
                self.assertEqual(verdicts(column, "1.5", after), ["worse"], f"{column}: {after}")

    def test_a_figure_where_none_was_is_new(self):
        for before in ("none", "-", "", "nan"):
            self.assertEqual(verdicts("ATE [m]", before, "1.5"), ["new"])
        self.assertEqual(verdicts("ATE [m]", "none", "none"), ["same"])
        self.assertEqual(verdicts("ATE [m]", "nan", "nan"), ["same"])

    def test_times_and_information_are_told(self):
        self.assertEqual(verdicts("time", "1", "9"), ["info"])
        self.assertEqual(verdicts("seen", "9", "1"), ["info"])


class Cells(unittest.TestCase):
    def test_several_figures_have_rules_of_their_own(self):
        self.assertEqual(verdicts("mixed", ".5 cm .986 23/24", ".6 cm .986 23/24"), ["worse", "same", "same"])
        self.assertEqual(verdicts("mixed", ".5 cm .900 23/24", ".5 cm .986 23/24"), ["same", "better", "same"])
        self.assertEqual(verdicts("mixed", ".5 cm .986 23/24", ".5 cm .986 22/24"), ["same", "same", "worse"])

    def test_another_number_of_figures_is_worse(self):
        self.assertEqual(verdicts("mixed", "1.0 / 2.0", "1.0"), ["worse"])
        self.assertEqual(verdicts("mixed", "1.0", "1.0 (130)"), ["worse"])

    def test_all_figures_of_a_cell_lost(self):
        self.assertEqual(verdicts("mixed", "1.0 / 2.0", "none"), ["worse", "worse"])

    def test_fractions(self):
        self.assertEqual(verdicts("doors", "23 of 24", "22 of 24"), ["worse"])
        self.assertEqual(verdicts("doors", "22 of 24", "23 of 24"), ["better"])
        self.assertEqual(verdicts("doors", "23/24", "22/24"), ["worse"])
        self.assertEqual(verdicts("doors", "3 of 3", "2 of 2"), ["worse"])
        self.assertEqual(verdicts("places", "30 of 30", "32 of 32"), ["same"])
        self.assertEqual(verdicts("places", "30 of 30", "30 of 32"), ["worse"])

    def test_a_verdict_that_turns_to_no_is_worse_under_every_rule(self):
        for column in ("met", "seen", "time", "ATE [m]"):
            self.assertEqual(verdicts(column, "yes", "**no**"), ["worse"])
            self.assertEqual(verdicts(column, "yes", "-"), ["worse"])
            self.assertEqual(verdicts(column, "**no**", "yes"), ["better"])
            self.assertEqual(verdicts(column, "**no**", "**no**"), ["same"])

    def test_verdicts_among_other_text(self):
        before, after = "length >= 20: yes; wrong <= 1 %: yes", "length >= 20: **no**; wrong <= 1 %: yes"
        self.assertEqual(verdicts("met", before, after), ["same", "worse", "same", "same"])
        self.assertEqual(verdicts("all", "yes, yes, yes", "yes, yes, **no**"), ["same", "same", "worse"])

    def test_targets_are_held(self):
        self.assertEqual(verdicts("target", "<= 5", "<= 6"), ["worse"])
        self.assertEqual(verdicts("target", "<= 5", ">= 5"), ["same", "worse"])
        self.assertEqual(verdicts("target", "0.7 +- 5e-5", "0.7 +- 5e-5"), ["same", "same"])

    def test_text(self):
        self.assertEqual(verdicts("kept", "chordal", "file"), ["worse"])
        self.assertEqual(verdicts("kept", "chordal", "chordal"), [])
        self.assertEqual(verdicts("seen", "chordal", "file"), ["info"])

    def test_names_with_digits_are_no_figures(self):
        figures, _ = tables.figures_of("kitti_00 M3500 -4.3e-15 R@1 (2.4 %)")
        self.assertEqual([figure.value for figure in figures], [-4.3e-15, 2.4])


class Rows(unittest.TestCase):
    columns = ("graph", "cost", "chi2", "target", "met", "time", "target", "met")

    def row(self, graph, cost, chi2="1.5"):
        return (graph, cost, chi2, "<= 2", "yes", "7", "<= 8", "yes")

    def test_a_row_is_named_by_as_many_cells_as_are_needed(self):
        before = file_of(self.columns, self.row("a", "g2o"), self.row("a", "log", "2.5"))
        after = file_of(self.columns, self.row("a", "log", "2.5"), self.row("a", "g2o", "1.9"))
        worse = [line for line in compared(before, after) if line.judgement.verdict == "worse"]
        self.assertEqual([(line.row, line.column) for line in worse], [("a, g2o", "chi2")])

    def test_columns_of_one_name_are_told_apart_by_their_subject(self):
        self.assertEqual(tables.unique_columns(list(self.columns))[3:5], ["target (chi2)", "met (chi2)"])
        self.assertEqual(tables.unique_columns(list(self.columns))[6:], ["target (time)", "met (time)"])

    def test_a_row_that_vanished_is_worse_and_a_new_one_is_new(self):
        before = file_of(("row", "x"), ("a", "1"), ("b", "2"))
        after = file_of(("row", "x"), ("a", "1"), ("c", "2"))
        told = {(line.row, line.judgement.verdict) for line in compared(before, after)}
        self.assertEqual(told, {("a", "same"), ("b", "worse"), ("c", "new")})

    def test_a_row_that_is_listed_as_renamed_is_compared(self):
        before, after = file_of(("row", "x"), ("b", "2")), file_of(("row", "x"), ("c", "3"))
        lines = compared(before, after, "rename town | b -> c\n* | * | * | lower 0")
        self.assertEqual([(line.row, line.before, line.after) for line in lines], [("c", "2", "3")])
        self.assertEqual(lines[0].judgement.verdict, "worse")
        self.assertEqual(compared(before, file_of(("row", "x")), "rename town | b -> (gone)"), [])

    def test_a_star_of_a_new_name_is_what_that_of_the_old_one_stood_for(self):
        before = file_of(("row", "x"), ("a, one eye, 7", "2"), ("b, one eye, 8", "4"))
        after = file_of(("row", "x"), ("a, monocular, 7", "2"), ("b, monocular, 8", "5"))
        lines = compared(before, after, "rename town | *, one eye, * -> *, monocular, *\n* | * | * | lower 0")
        self.assertEqual([(line.row, line.before, line.after) for line in lines],
                         [("a, monocular, 7", "2", "2"), ("b, monocular, 8", "4", "5")])

    def test_a_renamed_row_is_judged_by_the_rule_of_its_new_name(self):
        before, after = file_of(("row", "x"), ("b", "2")), file_of(("row", "x"), ("c", "3"))
        text = "rename town | b -> c\ntown | c | x | info\n* | * | * | equal 0"
        self.assertEqual([line.judgement.verdict for line in compared(before, after, text)], ["info"])

    def test_a_row_listed_as_renamed_to_one_that_is_not_there_is_gone(self):
        before, after = file_of(("row", "x"), ("b", "2")), file_of(("row", "x"), ("d", "2"))
        told = [line.judgement.verdict for line in compared(before, after, "rename town | b -> c")]
        self.assertEqual(told, ["worse", "new"])

    def test_columns_vanish_and_are_renamed(self):
        before, after = file_of(("row", "x", "y"), ("a", "1", "2")), file_of(("row", "x", "z"), ("a", "1", "2"))
        told = [(line.column, line.judgement.verdict) for line in compared(before, after)]
        self.assertEqual(told, [("x", "same"), ("y", "worse")])
        told = [(line.column, line.judgement.verdict) for line in compared(before, after, "rename town | * | y -> z")]
        self.assertEqual(told, [("x", "same"), ("z", "same")])

    def test_numbers_in_the_name_of_a_row_are_figures(self):
        before = file_of(("row", "x"), ("wrong, of 1071 views", "0"))
        after = file_of(("row", "x"), ("wrong, of 12 views", "0"))
        told = [(line.column, line.judgement.verdict) for line in compared(before, after)]
        self.assertEqual(told, [("(name)", "worse"), ("x", "same")])


class WideTables(unittest.TestCase):
    """One table that is written as two or three with the same first columns."""

    def page(self, *parts, heading="Town"):
        return "".join(file_of(*part, heading=heading).replace("<!-- section: town -->", "") for part in parts)

    def compared(self, before, after, text="* | * | * | equal 0"):
        mark = "<!-- section: town -->\n"
        lines = compared(mark + before, mark + after, text)
        return [(line.row, line.column, line.judgement.verdict) for line in lines]

    wide = (("row", "x", "target", "met", "y", "target", "met"), ("a", "1", "<= 2", "yes", "3", "<= 4", "yes"))
    first = (("row", "x", "target", "met"), ("a", "1", "<= 2", "yes"))

    def test_every_figure_is_found_in_one_of_the_parts(self):
        second = (("row", "y", "target", "met"), ("a", "3", "<= 4", "yes"))
        for before, after in (((self.wide,), (self.first, second)), ((self.first, second), (self.wide,)),
                              ((self.first, second), (self.first, second))):
            told = self.compared(self.page(*before), self.page(*after))
            self.assertEqual({line[2] for line in told}, {"same"}, told)
            self.assertEqual({line[1] for line in told}, {"x", "y", "target (x)", "target (y)", "met (x)", "met (y)"})

    def test_a_figure_of_the_second_part_that_is_worse_or_gone(self):
        worse = self.page(self.first, (("row", "y", "target", "met"), ("a", "5", "<= 4", "**no**")))
        told = self.compared(self.page(self.wide), worse)
        self.assertEqual([line[1] for line in told if line[2] == "worse"], ["y", "met (y)"])
        told = self.compared(self.page(self.wide), self.page(self.first))
        self.assertIn(("a", "y", "worse"), told)

    def test_three_parts(self):
        parts = [(("row", name), ("a", "1"), ("b", "2")) for name in "xyz"]
        wide = (("row", "x", "y", "z"), ("a", "1", "1", "1"), ("b", "2", "2", "2"))
        told = self.compared(self.page(wide), self.page(*parts))
        self.assertEqual([line[2] for line in told], ["same"] * 6)

    def test_tables_of_other_rows_or_of_a_common_column_are_tables_of_their_own(self):
        for second in ((("row", "x", "z"), ("a", "2", "3")), (("row", "z"), ("b", "3")), (("other", "z"), ("a", "3")),
                       (("row", "z"), ("a", "3"), ("b", "4"))):
            section = tables.parse("<!-- section: town -->\n" + self.page((("row", "x"), ("a", "1")), second), "page")
            self.assertEqual(len(tables.joined_tables(section["town"].tables)), 2, second)
        text = "<!-- section: town -->\n" + self.page((("row", "x"), ("a", "1"))) + \
            self.page((("row", "z"), ("a", "1")), heading="Another")
        self.assertEqual(len(tables.joined_tables(tables.parse(text, "page")["town"].tables)), 2)


class Sections(unittest.TestCase):
    def test_sections_vanish_and_are_renamed(self):
        before, after = file_of(("row", "x"), ("a", "1")), file_of(("row", "x"), ("a", "1"), section="city")
        self.assertEqual([line.judgement.verdict for line in compared(before, after)], ["worse"])
        told = [(line.section, line.judgement.verdict) for line in compared(before, after, "rename town -> city")]
        self.assertEqual(told, [("city", "same")])

    def test_a_section_that_failed_is_worse(self):
        after = "<!-- section: town -->\n\n### town\n\n**no**: failed, see `out`.\n"
        lines = compared(file_of(("row", "x"), ("a", "1")), after)
        self.assertEqual([line.judgement.verdict for line in lines], ["worse"])
        self.assertIn("failed", lines[0].row)

    def test_tables_of_another_heading_are_matched_in_order(self):
        before = file_of(("row", "x"), ("a", "1"))
        told = compared(before, file_of(("row", "x"), ("a", "1"), heading="Another"))
        self.assertEqual([line.judgement.verdict for line in told], ["same"])
        told = compared(before, "<!-- section: town -->\n\n### Town\n\n| other | x |\n|---|---|\n| a | 1 |\n")
        self.assertEqual([line.judgement.verdict for line in told], ["worse", "new"])

    def test_times_are_told_by_their_reference_runs(self):
        foot = "Measured at 1 on 2 cores (X); reference run {} s ({} before, {} after)."
        before = file_of(("row", "time"), ("a", "1.0"), foot=foot.format("0.200", "0.2", "0.2"))
        after = file_of(("row", "time"), ("a", "2.2"), foot=foot.format("0.400", "0.4", "0.4"))
        line, = compared(before, after)
        self.assertEqual(line.judgement.verdict, "info")
        self.assertIn("+10 % by the reference runs", line.judgement.change)


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    def pages(self, folder="pages", **texts):
        """A folder of results with a page of each name; None: no page."""
        path = pathlib.Path(self.folder.name) / folder
        path.mkdir(exist_ok=True)
        for name, text in texts.items():
            if text is not None:
                (path / f"{name}.md").write_text(text, encoding="utf-8")
        return str(path)

    def run_program(self, *arguments, program=PROGRAM):
        done = subprocess.run([sys.executable, "-B", program, *arguments], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def refused(self, *arguments):
        code, _, errors = self.run_program(*arguments)
        self.assertEqual(code, 2, arguments)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        return errors

    def test_exit_codes(self):
        tolerances = self.file("t.txt", RULES)
        before = self.file("before.md", file_of(("row", "ATE [m]"), ("a", "1.00"), ("b", "1.00")))
        after = self.file("after.md", file_of(("row", "ATE [m]"), ("a", "2.00"), ("b", "1.01")))
        code, told, _ = self.run_program("compare", before, before, "--tolerances", tolerances)
        self.assertEqual((code, "2 figures: 2 unchanged." in told), (0, True), told)
        code, told, _ = self.run_program("compare", before, after, "town", "--tolerances", tolerances)
        self.assertEqual(code, 1)
        self.assertIn("| town | a | ATE [m] | 1.00 | 2.00 | +100 % | lower 2 % | **worse** |", told)
        self.assertIn("| town | b | ATE [m] | 1.00 | 1.01 | +1 % | lower 2 % | same |", told)

    def test_what_cannot_be_compared_is_refused_in_one_line(self):
        good = self.file("good.md", file_of(("row", "x"), ("a", "1")))
        self.assertIn("no section of results", self.refused("compare", self.file("empty.md", ""), good))
        ragged = self.file("ragged.md", file_of(("row", "x"), ("a", "1", "2")))
        self.assertIn("ragged.md:7: 3 cells where the head has 2", self.refused("compare", ragged, good))
        self.assertIn("does not end", self.refused("fetch", self.file("open.md", "<!-- section: a -->\n| b | c\n")))
        self.assertIn("dashes", self.refused("fetch", self.file("bare.md", "<!-- section: a -->\n| b | c |\n")))
        twice = file_of(("row", "x"), ("a", "1"))
        self.assertIn("second section", self.refused("fetch", self.file("twice.md", twice + twice)))
        self.assertIn("neither", self.refused("compare", good, self.folder.name + "/nowhere.md"))
        self.assertIn("neither", self.refused("compare", good, "no-such-revision"))
        self.assertIn("no page of results", self.refused("fetch", self.pages(empty=None)))
        self.assertIn("no section city", self.refused("fetch", good, "city"))
        self.assertIn("section city", self.refused("compare", good, good, "city"))

    town = "# Town\n\n    a command\n\n| row | ATE [m] |\n|---|---|\n| a | 1.00 |\n\n## Second\n\n| row | x |\n|---|---|\n| b | 1 |\n"

    def test_a_folder_of_pages_is_read_as_a_single_file_is(self):
        single = self.file("single.md", "<!-- section: town -->\n\n" + self.town.replace("## ", "### ").replace("# Town", "### Town"))
        folder = self.pages(town=self.town)
        for before, after in ((single, folder), (folder, single), (folder, folder)):
            code, told, errors = self.run_program("compare", before, after)
            self.assertEqual((code, errors), (0, ""))
            self.assertIn("2 figures: 2 unchanged.", told)
        other = self.pages("other", town=self.town.replace("1.00", "2.00"), city="# City\n\n| row | x |\n|---|---|\n| a | 1 |\n")
        code, told, _ = self.run_program("compare", single, other)
        self.assertEqual(code, 1)
        self.assertIn("| town | a | ATE [m] | 1.00 | 2.00 | +100 % |", told)
        code, told, _ = self.run_program("compare", other, folder)
        self.assertIn("| city | all of its rows | - | - | - | gone | - | **worse** |", told)

    def test_a_baseline_of_pages_is_printed_as_a_single_file(self):
        folder = self.pages(town=self.town, city="# City\n\nAbsent: the data are not on this machine.\n")
        code, text, _ = self.run_program("fetch", folder, "town")
        self.assertEqual(code, 0)
        code, told, _ = self.run_program("compare", self.file("single.md", text), folder)
        self.assertEqual((code, "2 figures: 2 unchanged." in told), (0, True), told)
        self.assertIn("no section village", self.refused("fetch", folder, "village"))

    def test_a_malformed_page_is_named_with_its_own_path_and_line(self):
        good = self.pages("good", town=self.town)
        ragged = self.pages("ragged", town=self.town, zebra=self.town + "| c | 2 | 3 |\n")
        self.assertIn("ragged/zebra.md:14: 3 cells where the head has 2", self.refused("compare", ragged, good))
        self.assertIn("ragged/zebra.md:14:", self.refused("fetch", ragged))
        bare = self.pages("bare", town="| row | x |\n|---|---|\n| a | 1 |\n")
        self.assertIn("bare/town.md:1: a page of results begins with", self.refused("compare", good, bare))
        latin = self.pages("latin")
        (pathlib.Path(latin) / "town.md").write_bytes(b"# Town \xff\n")
        self.assertIn("cannot be read", self.refused("compare", good, latin))

    def test_a_git_revision_of_either_form(self):
        root = pathlib.Path(self.folder.name) / "project"
        program = root / "scripts" / "results.d" / "against.py"
        program.parent.mkdir(parents=True)
        for source in PROGRAM.parent.glob("*.[pt][yx]*"):
            (program.parent / source.name).write_bytes(source.read_bytes())
        (root / "docs").mkdir()

        def commit(name):
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false", "commit",
                            "-qm", name], cwd=root, check=True)
            subprocess.run(["git", "tag", name], cwd=root, check=True)

        subprocess.run(["git", "init", "-q"], cwd=root, check=True)
        (root / "docs" / "results.md").write_text("<!-- section: town -->\n\n" + self.town, encoding="utf-8")
        subprocess.run(["git", "add", "docs"], cwd=root, check=True)
        commit("single")
        (root / "docs" / "results").mkdir()
        (root / "docs" / "results" / "town.md").write_text(self.town, encoding="utf-8")
        (root / "docs" / "results.md").write_text("# Results\n\n| figure | measured |\n|---|---|\n| a | 1 |\n", encoding="utf-8")
        subprocess.run(["git", "add", "docs"], cwd=root, check=True)
        commit("pages")
        (root / "docs" / "results" / "town.md").write_text(self.town + "| c |\n", encoding="utf-8")
        subprocess.run(["git", "add", "docs"], cwd=root, check=True)
        commit("ragged")
        for before, after in (("single", "pages"), ("pages", "single"), ("pages", str(root / "docs" / "results"))):
            if after.startswith("/"):
                (root / "docs" / "results" / "town.md").write_text(self.town, encoding="utf-8")
            code, told, errors = self.run_program("compare", before, after, program=program)
            self.assertEqual((code, errors), (0, ""))
            self.assertIn("2 figures: 2 unchanged.", told)
        code, _, errors = self.run_program("compare", "pages", "ragged", program=program)
        self.assertEqual((code, errors), (2, "scripts/results: ragged:docs/results/town.md:14: 1 cells where the head has 2\n"))
        code, _, errors = self.run_program("compare", "pages", "nothing", program=program)
        self.assertEqual((code, len(errors.splitlines()), "neither" in errors), (2, 1, True), errors)

    def test_bad_tolerances_are_refused(self):
        good = self.file("good.md", file_of(("row", "x"), ("a", "1")))
        for text in ("a | b | lower 2 %", "a | b | c | less 2 %", "a | b | c | lower x %", "rename a b",
                     "a | b | c | lower -2 %", "a | b | c | lower nan"):
            self.assertIn("t.txt:1", self.refused("compare", good, good, "--tolerances", self.file("t.txt", text)))

    def test_the_results_of_the_project_are_read_to_the_last_figure(self):
        results = ROOT / "docs" / "results"
        code, told, errors = self.run_program("compare", str(results), str(results), "--all")
        self.assertEqual((code, errors), (0, ""))
        self.assertNotIn("**worse**", told)


if __name__ == "__main__":
    unittest.main()
