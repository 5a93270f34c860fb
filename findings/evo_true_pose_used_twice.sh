#!/bin/sh
# evo 1.38.1 (PyPI), seen 2026-11-29.
#
# Input: a straight drive of 10 m/s. The truth has 100 Hz and 10 s (1001 poses). The estimate has
# 200 Hz and covers the first second (201 poses); each of its positions is exact.
#
# Expected: an APE and an RPE of 0 m over 101 pairs. Every true pose of that second has an estimated
# pose of the same stamp. The 100 estimated poses between them have no true pose of their own: the
# nearest ones, 5 ms away, are the partners of others.
#
# Seen: evo_ape gives RMSE 0.035267 m and evo_rpe 0.050000 m in every step. evo begins at the
# trajectory that has fewer poses, which is not the one of the lower rate here, and lets several of
# its poses take the same partner (matching_time_indices() in core/sync.py). Each true pose but the
# last is used twice: once 0 ms and once 5 ms away, which is 0.05 m. Each step goes from the one kind
# to the other, so that the error of the pairing is an error of the system in every step.
#
# Instead: users give `--sync_method interpolation`, which evo has for trajectories of two rates, or a
# --t_max_diff below half the step of the denser one. This script does both at its end: 0 m.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check evo==1.38.1
export HOME="$dir" # evo keeps its settings there

env/bin/python - <<'PYTHON'
for name, step, count in (("truth.tum", 0.01, 1001), ("estimate.tum", 0.005, 201)):
    with open(name, "w") as file:
        for i in range(count):
            file.write(f"{i * step:.3f} {10 * i * step:.3f} 0 0 0 0 0 1\n")
PYTHON

rmse() { tool=$1; shift; "env/bin/$tool" tum truth.tum estimate.tum "$@" | awk '$1 == "rmse" { print $2 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[0-9]/ && a - b < 1e-4 && b - a < 1e-4) }'; }

absolute=$(rmse evo_ape)
relative=$(rmse evo_rpe)
between=$(rmse evo_rpe --sync_method interpolation)
strict=$(rmse evo_rpe --t_max_diff 0.002)
echo "APE: $absolute m"
echo "RPE: $relative m"
echo "RPE with --sync_method interpolation: $between m"
echo "RPE with --t_max_diff 0.002: $strict m"

if near "$absolute" 0.035267 && near "$relative" 0.05 && near "$between" 0 && near "$strict" 0; then
  exit 0
fi
echo "changed: 0.035267, 0.05, 0 and 0 m were seen"
exit 1
