#!/bin/sh
# slam-regression-ci 0.2.1 (PyPI), seen 2026-11-29.
#
# Input: a drive on circles of 10 m (201 poses) and estimates whose height swings by 1 cm. The
# candidate's height swings by 1 m. The configuration has one rule: `ate_rmse: {max_mad_multiples: 3}`.
# The baseline is recorded from one run, as in the README's quickstart.
#
# Expected: `slam-regression compare` fails (exit 1), or says that the rule needs a baseline of several
# runs (exit 2, an error of the configuration). The candidate is 100 times as wrong, and the rule is
# the only one: what it cannot judge must not pass. Of a baseline of two runs it fails the candidate.
#
# Seen: "baseline:  0.007075 m", "candidate: 0.707479 m", "change: n/a", "STATUS: PASS", exit 0, and
# no note or warning.
# compare_metric() in policy.py, which judges against a baseline of one run, does not look at
# max_mad_multiples. Since 0.2.1 the note "no threshold configured", which 0.2.0 gave here, is
# gone, too: _rule_notes() counts the rule as configured. The README calls the rule one for
# "multi-run baselines"; the program accepts it for others.
#
# Instead: users add a rule that works with one run (max_relative_regression_percent or max_value), or
# record several runs. This script does the latter at its end: FAIL, exit 1.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check slam-regression-ci==0.2.1
export HOME="$dir"

env/bin/python - <<'PYTHON'
from math import cos, sin

def write(name, swing, pitch):
    with open(name, "w") as file:
        for i in range(201):
            t = i / 10
            z = swing * sin(pitch * t)
            file.write(f"{t:.1f} {10 * sin(t):.9f} {10 - 10 * cos(t):.9f} {z:.9f} 0 0 0 1\n")

write("truth.tum", 0, 0)
write("run1.tum", 0.01, 37)
write("run2.tum", 0.0101, 38)
write("candidate.tum", 1, 37)
PYTHON
echo 'metrics: {ate_rmse: {max_mad_multiples: 3}}' >rules.yaml

judge() { # name, runs of the baseline
  name=$1
  shift
  env/bin/slam-regression record --config rules.yaml --reference truth.tum --estimate "$@" \
    --json "$name.json" >/dev/null
  code=0
  env/bin/slam-regression compare --config rules.yaml --baseline "$name.json" --reference truth.tum \
    --estimate candidate.tum >"$name.txt" 2>&1 || code=$?
  echo "exit $code" >>"$name.txt"
  echo "$name:" $(cat "$name.txt")
}
metres() { sed -n "s/ *$1: *\\([0-9.]*\\) m/\\1/p" "$2"; }
between() { awk -v a="$1" -v l="$2" -v h="$3" 'BEGIN { exit !(a ~ /^[0-9]/ && a > l && a < h) }'; }

judge one run1.tum
judge two run1.tum run2.tum

if between "$(metres baseline one.txt)" 0.006 0.008 && between "$(metres candidate one.txt)" 0.6 0.8 &&
  grep -q '^STATUS: PASS' one.txt && grep -q '^exit 0' one.txt && ! grep -qi -e note -e warning one.txt &&
  grep -q '^STATUS: FAIL' two.txt && grep -q '^exit 1' two.txt; then
  exit 0
fi
echo "changed: PASS with exit 0 and no note was seen for one run, FAIL with exit 1 for two"
exit 1
