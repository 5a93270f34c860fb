"""words_selftest.py WORDS: words.py finds what is planted and leaves the allowed alone."""
import os
import subprocess
import sys
import tempfile

PLANTED = [  # file, text, the line of the fault or None
    ("graph/a.h", "/// Depth of a point.\ndouble depth;\n", None),
    ("graph/a.h", "/// What the right eye sees.\ndouble depth;\n", 1),
    ("graph/a.h", "struct A {\n  int left_eye = 0;  ///< left\n};\n", 2),
    ("graph/a.h", "struct SecondEye {};\n", 1),
    ("graph/a.h", "int Eyelash = 0;  // a word that only begins like a refused one\n", None),
    ("graph/a.h", "/// of a motion\nint a;\n", 1),
    ("graph/a.h", "/// The variance\n/// of a motion.\nint a;\n", None),
    ("graph/a.h", "int a = 0;  ///< of either [m]\n", 1),
    ("graph/a.cpp", 'void f() { fail("no sight of it"); }\n', 1),
    ("graph/a.cpp", 'field.formerly("sight")("observation", o.x, "view");\n', None),
    ("graph/a.cpp", 'field("min_turn_deg", o.x, "minimum rotation");\n', 1),
    ("apps/a.cpp", 'command.add_flag("--look-at-eye", x, "what");\n', 1),
    ("apps/a.cpp", 'option->check(CLI::IsMember({"hover", "run"}));\n', 1),
    ("graph/a.cpp", 'json["sights"] = 1; json = {{"sights", 1}};\n', None),
    ("graph/a.cpp", "const cv::Mat m = cv::Mat::eye(3, 3, CV_64F);\n", None),
    ("graph/a.cpp", "double log_odds = 0;  // log odds of a label\n", None),
    ("graph/a.cpp", "int turn_rate = 0;\n", 1),
    ("tests/a.cpp", "int eye = 0;\n", 1),
    ("graph/a.h", "int the_answer = 0;\n", 1),
    ("tests/a.cpp", "int the_answer = 0;\n", None),
    ("tests/a.cpp", "// what the eye sees\nint a = 0;\n", None),
    ("docs/a.md", "The camera.\n\nTwo eyes see\nmore.\n", 3),
    ("docs/a.md", "`eye` and\n\n```\ntwo eyes\n```\n", None),
    ("docs/a.md", "The free\nunits of a map.\n", 1),
    ("README.md", "Places are believed.\n", 1),
    ("docs/results.md", "# Results\n\n| one eye | 1 |\n", 3),
    ("docs/results/town.md", "# The town, two eyes\n", 1),
    ("docs/elements.md", "One eye.\n", None),
    ("scripts/results.d/a.sh", "# A section.\ncells \"ten frames: one eye\" 1\n", 2),
    ("scripts/results.d/a.sh", "cells \"$(number \"$f\" sightings)\" \"$(digits \"$(number \"$out/a.json\" told)\")\"\n", None),
    ("scripts/results.d/summary.txt", "one eye | town | a | b | - | - | -\n", 1),
    ("scripts/results.d/tolerances.txt", "rename a | one eye -> monocular\n", None),
]


def faults_of(program, file, text):
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, os.path.dirname(file)), exist_ok=True)
        with open(os.path.join(root, file), "w", encoding="utf-8") as out:
            out.write(text)
        run = subprocess.run([sys.executable, program, root], capture_output=True, text=True)
        return run.returncode, [line for line in run.stdout.splitlines() if line.startswith(file)]


def main():
    wrong = []
    for file, text, line in PLANTED:
        code, faults = faults_of(sys.argv[1], file, text)
        expected = line is not None
        if code != int(expected) or bool(faults) != expected:
            wrong.append(f"{file} {text!r}: exit code {code}, {faults}")
        elif expected and not faults[0].startswith(f"{file}:{line}:"):
            wrong.append(f"{file} {text!r}: not in line {line}: {faults}")
    print("\n".join(wrong) or f"{len(PLANTED)} planted texts are judged rightly")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
