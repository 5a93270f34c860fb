"""Whether scripts/same_bits finds and names what it must, by fake programs. Needs no build.

Usage: python3 tests/lint/same_bits_selftest.py
"""
import contextlib
import io
import os
import stat
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(ROOT, "scripts", "same_bits.d"))

import main
from case import Case, Copy, Make, Run

# A program that writes one file of each kind. A test changes one piece of this text.
FAKE = r'''#!/usr/bin/python3 -S
import os, sqlite3, sys, time
words = sys.argv[1:]
if words[:1] == ["run"]:
    out = words[words.index("--out") + 1]
    os.makedirs(out)
    def put(name, data):
        with open(os.path.join(out, name), "wb") as file:
            file.write(data)
    put("trajectory.txt", b"0 1.25\n1 2.5\n2 3.75\n")
    put("places.json", b'{\n "ate_m": 0.125,\n "stages": [\n  {"name": "flow", "cpu_s": %.9f}\n ],\n "zones": 3\n}\n' % time.perf_counter())
    put("options.yaml", b"seed: 7\ngates:\n  min_inliers: 12\n  cpu_ms: %.9f\n" % time.perf_counter())
    put("loops.csv", b"query,match\n1,2\n")
    put("plot.png", b"\x89PNG\0\x01\x02\x03\x04")
    map = sqlite3.connect(os.path.join(out, "map.db"))
    map.execute("CREATE TABLE place (id INTEGER PRIMARY KEY, scale REAL, data BLOB)")
    map.executemany("INSERT INTO place VALUES (?, ?, ?)", [(1, 1.0, b"ab"), (2, 0.1, b"cd")])
    map.execute("CREATE TABLE stage (id INTEGER PRIMARY KEY, cpu_s REAL, calls INTEGER, checksum INTEGER)")
    map.execute("INSERT INTO stage VALUES (1, ?, 7, ?)", (time.perf_counter(), time.perf_counter_ns()))
    map.commit()
    print("world        3 frames posed")
    print("             %.1f s, %.1f ms CPU a frame, results in %s/%s" % (time.perf_counter(), time.perf_counter(), os.getcwd(), out))
elif words[:1] == ["eval"]:
    with open(os.path.join(words[1], "trajectory.txt")) as file:
        print("sum", sum(float(line.split()[1]) for line in file))
elif words[:1] == ["echo"]:
    print(" ".join(words[1:]))
sys.exit(3 if words[:1] == ["break"] else 0)
'''

MADE = Case("made", "", ("run world --out run",))
ECHO = Case("echo", "", ("echo --gt a --set scene.urban.step=3",))


class SameBits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def program(self, name, *changes):
        text = FAKE
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        return self.write(name, text, executable=True)

    def write(self, name, text, executable=False):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        if executable:
            os.chmod(self.path(name), stat.S_IRWXU)
        return self.path(name)

    def compare(self, *changes, cases=(MADE,), renamed="", more=()):
        """Exit code and printed text of a comparison of the fake program with a changed one."""
        printed = io.StringIO()
        arguments = ["BASE", "--base-program", self.program("base_program"), "--program", self.program("present_program", *changes),
                     "--out", self.path("out"), "--data", self.folder.name, *more]
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            code = main.main(arguments, list(cases), self.write("renamed.txt", renamed))
        return code, printed.getvalue()

    def expect_difference(self, change, *pieces, cases=(MADE,)):
        code, text = self.compare(change, cases=cases)
        self.assertEqual(code, 1, text)
        self.assertIn("DIFFERENT", text)
        for piece in pieces:
            self.assertIn(piece, text)
        self.assertEqual(text.count("\n    "), 1, text)  # nothing else differs

    def test_times_and_paths_alone_are_no_difference(self):
        code, text = self.compare()
        self.assertEqual(code, 0, text)
        self.assertIn("7 files compared, 5 values masked", text)  # six outputs and standard output; cpu_s, cpu_ms, s, ms, folder

    def test_a_changed_value_of_a_text_is_named_with_its_line(self):
        self.expect_difference(("1 2.5", "1 2.6"), "run/trajectory.txt: line 2: base '1 2.5', present '1 2.6'")

    def test_a_changed_value_of_json_is_named_with_its_key(self):
        self.expect_difference(('"ate_m": 0.125', '"ate_m": 0.1250'), "run/places.json: line 2, ate_m: base '0.125', present '0.1250'")

    def test_another_layout_of_json_is_a_difference(self):
        self.expect_difference(('"ate_m": 0.125', '"ate_m":  0.125'), "run/places.json: line 2")

    def test_a_changed_value_of_yaml_is_named(self):
        self.expect_difference(("min_inliers: 12", "min_inliers: 13"), "run/options.yaml: line 3", "13")

    def test_a_changed_byte_of_a_picture_is_named_with_its_offset(self):
        self.expect_difference((r"PNG\0\x01\x02", r"PNG\0\x01\x07"), "run/plot.png: byte 6: base 02 03 04, present 07 03 04")

    def test_a_changed_cell_of_a_database_is_named_with_its_row(self):
        self.expect_difference(("(2, 0.1,", "(2, 0.10000000000000002,"), "run/map.db: table place, id 2, column scale: base 0.1, present 0.10000000000000002")
        self.expect_difference(('b"cd"', 'b"ce"'), "table place, id 2, column data", "byte 1")

    def test_a_changed_cell_beside_a_masked_one_is_named(self):
        self.expect_difference(("(1, ?, 7, ?)", "(1, ?, 8, ?)"), "table stage, id 1, column calls: base 7, present 8")

    def test_a_missing_and_an_additional_row_are_named(self):
        self.expect_difference((', (2, 0.1, b"cd")', ""), "table place, id 2: only in base")
        self.expect_difference(('b"cd")', 'b"cd"), (3, 0, None)'), "table place, id 3: only in present")

    def test_a_missing_and_an_additional_file_are_named(self):
        self.expect_difference(('put("loops.csv"', 'str("loops.csv"'.replace("str", "(lambda *a: 0)")), "run/loops.csv: only in base")
        self.expect_difference(('    put("plot.png"', '    put("new.txt", b"")\n    put("plot.png"'), "run/new.txt: only in present")

    def test_printed_text_counts(self):
        self.expect_difference(("3 frames posed", "2 frames posed"), "stdout_1.txt: line 1", "2 frames posed")
        self.expect_difference(("ms CPU a frame", "ms CPU each"), "stdout_1.txt: line 2")

    def test_a_different_exit_code_is_named(self):
        self.expect_difference(("exit(3 if", "exit(4 if"), "command 1 (break): exit code: base 3, present 4", cases=(Case("broken", "", (Run("break", exits=3),)),))

    def test_an_expected_exit_code_is_no_failure(self):
        code, text = self.compare(cases=(MADE, Case("broken", "", (Run("break", exits=3), "echo after"))))
        self.assertEqual(code, 0, text)

    def test_two_programs_that_fail_alike_are_a_failure(self):
        code, text = self.compare(cases=(Case("broken", "", ("break",)),))
        self.assertEqual(code, 1, text)
        self.assertIn("both exit with 3, expected 0", text)

    def test_a_comparison_of_nothing_is_a_failure(self):
        code, text = self.compare(cases=(Case("silent", "", ("nothing",)),))
        self.assertEqual(code, 1, text)
        self.assertIn("no file was compared", text)
        code, text = self.compare(cases=(Case("absent", "", ("echo {data}/none/x",)),))
        self.assertEqual(code, 1, text)
        self.assertIn("nothing was compared", text)

    def test_absent_data_skip_a_case(self):
        code, text = self.compare(cases=(MADE, Case("absent", "", ("echo {data}/none/x",))))
        self.assertEqual(code, 0, text)
        self.assertIn("absent: none/x", text)

    def test_a_renamed_file_is_followed(self):
        change = ("trajectory.txt", "poses.txt")
        code, text = self.compare(change)
        self.assertEqual(code, 1, text)
        self.assertIn("run/poses.txt: only in present", text)
        code, text = self.compare(change, renamed="file trajectory.txt -> poses.txt\n", cases=(MADE, Case("sum", "", (Copy("made/run", "run"), "eval run"))))
        self.assertEqual(code, 0, text)

    def test_a_renamed_key_is_followed_wherever_it_is_sorted(self):
        change = ('"ate_m": 0.125,\\n ', ""), ('"zones": 3', '"zones": 3,\\n "zz_m": 0.125'), ("min_inliers", "least_inliers"), ("query,match", "query,candidate")
        code, text = self.compare(*change)
        self.assertEqual(code, 1, text)
        renamed = "key ate_m -> zz_m\nkey gates.none -> x\nkey min_inliers -> least_inliers\nkey match -> candidate\n"
        code, text = self.compare(*change, renamed=renamed)
        self.assertEqual(code, 0, text)
        code, text = self.compare(*change, ('"zz_m": 0.125', '"zz_m": 0.126'), renamed=renamed)
        self.assertEqual(code, 1, text)
        self.assertIn("zz_m: base '0.125', present '0.126'", text)

    def test_a_renamed_command_option_and_setting_are_followed(self):
        renamed = "command echo -> say loud\noption --gt -> --truth\noption eval --gt -> --other\nsetting scene.urban -> scene.street\n"
        change = (('words[:1] == ["echo"]', 'words[:2] == ["say", "loud"]'), ("words[1:]", "words[2:]"))
        code, text = self.compare(*change, cases=(ECHO,))
        self.assertEqual(code, 1, text)
        code, text = self.compare(*change, cases=(ECHO,), renamed=renamed)
        self.assertEqual(code, 0, text)
        with open(self.path("out/present/echo/stdout_1.txt"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "--truth a --set scene.street.step=3\n")

    def test_a_renamed_table_and_column_are_followed(self):
        change = ("TABLE place (", "TABLE places ("), ("INTO place ", "INTO places "), ("scale REAL", "size REAL")
        code, text = self.compare(*change, renamed="table place -> places\ncolumn place.scale -> size\n")
        self.assertEqual(code, 0, text)

    def test_a_difference_does_not_spread(self):
        cases = (MADE, Case("sum", "", (Copy("made/run", "run"), "eval run")), Case("place", "", ("eval {made}/run",)))
        code, text = self.compare(("1 2.5", "1 2.6"), cases=cases)
        self.assertEqual(code, 1, text)
        self.assertIn("3 cases: 2 identical, 1 different", text)

    def test_a_case_brings_the_cases_that_it_needs(self):
        cases = (MADE, ECHO, Case("sum", "", ("eval {made}/run",)))
        code, text = self.compare(cases=cases, more=("--case", "sum"))
        self.assertEqual(code, 0, text)
        self.assertIn("2 cases: 2 identical", text)

    def test_inputs_are_made_once_for_both_programs(self):
        made = []
        def make(path, what):
            made.append(what)
            os.makedirs(path, exist_ok=True)
            with open(os.path.join(path, "trajectory.txt"), "w", encoding="utf-8") as file:
                file.write(what)
        code, text = self.compare(cases=(Case("sum", "", (Make(make, "given", ("0 4",)), "eval {inputs}/given")),))
        self.assertEqual(code, 0, text)
        self.assertEqual(made, ["0 4"])

    def test_bad_use_is_told(self):
        code, text = self.compare(more=("--case", "none"))
        self.assertEqual(code, 2, text)
        self.assertIn("none: is no case", text)
        code, text = self.compare(renamed="file a b\n")
        self.assertEqual(code, 2, text)
        with self.assertRaises(SystemExit) as stopped, contextlib.redirect_stderr(io.StringIO()):
            main.main(["--quick"], [MADE])
        self.assertEqual(stopped.exception.code, 2)

    def test_the_table_of_cases_is_sound(self):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.assertEqual(main.main(["--list"]), 0)
        self.assertIn("render_town", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
