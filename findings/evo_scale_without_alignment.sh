#!/bin/sh
# evo 1.38.1 (PyPI), seen 2026-11-29.
#
# Input: a drive of 20 m that begins at x = 100 m. The estimate begins at the same pose, its
# orientations are right, and its motion is half as long: its positions are the truth, scaled by 0.5
# about the first one. That is a monocular system which was given its first pose.
#
# Expected: `evo_ape -s` ("correct scale with Umeyama's method") gives 0 m. Both trajectories have the
# same start and the same directions, and only the scale differs, which the option corrects. At the
# least, the correction of an exact scale error must not make the error larger.
#
# Seen: RMSE 5.762457 m without -s, and 100.000000 m with it, in every pose. align() in
# core/trajectory.py finds the right scale, 2, by a fit that also has a rotation and a translation.
# With correct_only_scale it applies only the scale, about the origin of the world: the start moves
# from 100 m to 200 m. The error depends on where the world's origin is.
#
# Instead: users give `--align_origin -s`, which scales, and then moves the first pose onto the true
# one, or `-a -s`. Both give 0 here; this script runs them at its end.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check evo==1.38.1
export HOME="$dir" # evo keeps its settings there

env/bin/python - <<'PYTHON'
from math import sin

with open("truth.tum", "w") as truth, open("estimate.tum", "w") as estimate:
    for i in range(200):
        t = i / 10
        truth.write(f"{t:.1f} {100 + t:.9f} {sin(t):.9f} 0 0 0 0 1\n")
        estimate.write(f"{t:.1f} {100 + t / 2:.9f} {sin(t) / 2:.9f} 0 0 0 0 1\n")
PYTHON

rmse() { env/bin/evo_ape tum truth.tum estimate.tum "$@" | awk '$1 == "rmse" { print $2 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[0-9]/ && a - b < 1e-4 && b - a < 1e-4) }'; }

plain=$(rmse)
scaled=$(rmse -s)
origin=$(rmse --align_origin -s)
aligned=$(rmse -a -s)
echo "APE without an option: $plain m"
echo "APE with -s:           $scaled m"
echo "APE with --align_origin -s: $origin m"
echo "APE with -a -s:        $aligned m"

if near "$plain" 5.762457 && near "$scaled" 100 && near "$origin" 0 && near "$aligned" 0; then
  exit 0
fi
echo "changed: 5.762457, 100, 0 and 0 m were seen"
exit 1
