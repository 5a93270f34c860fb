#!/bin/sh
# evo 1.38.1 (PyPI), seen 2026-11-29.
#
# Input: a straight drive of 1 m/s with 100 true poses at 10 Hz. The estimate is perfect for 40 frames
# and has no pose for the next 20. Then it goes on for 40 frames, 2 m to the side and otherwise perfect.
#
# Expected: `evo_rpe` over 1 frame, its default, gives 0 m for the 78 steps of 0.1 s, or names the
# gap. The RPE is the error of a motion over a fixed interval, and evo's notebook on the metrics
# says: for the RPE of every second at 30 poses a second, use delta = 30 frames.
#
# Seen: RMSE 0.225018 m = 2 m / sqrt(79) and a maximum of 2.000000 m, "for delta = 1 (frames)". evo
# counts the poses that found a partner, not frames (filter_pairs_by_index() in core/filters.py): the
# step of 2.1 s across the gap is one "frame" among those of 0.1 s. Nothing names it. The more frames
# a system loses, the longer are its steps, and the figures of two systems are over other intervals.
#
# Instead: users judge the parts between gaps one by one with --t_end and --t_start, as this script
# does at its end, or split the associated trajectories by split_time_gaps() of evo's API.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check evo==1.38.1
export HOME="$dir" # evo keeps its settings there

env/bin/python - <<'PYTHON'
with open("truth.tum", "w") as truth, open("estimate.tum", "w") as estimate:
    for i in range(100):
        t = i / 10
        truth.write(f"{t:.1f} {t:.1f} 0 0 0 0 0 1\n")
        if i < 40 or i >= 60:
            estimate.write(f"{t:.1f} {t:.1f} {0 if i < 40 else 2} 0 0 0 0 1\n")
PYTHON

value() { name=$1; shift; "env/bin/$@" | awk -v name="$name" '$1 == name { print $2 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[0-9]/ && a - b < 1e-4 && b - a < 1e-4) }'; }

rmse=$(value rmse evo_rpe tum truth.tum estimate.tum)
max=$(value max evo_rpe tum truth.tum estimate.tum)
before=$(value max evo_rpe tum truth.tum estimate.tum --t_end 3.95)
after=$(value max evo_rpe tum truth.tum estimate.tum --t_start 5.95)
echo "RPE over 1 frame: RMSE $rmse m, max $max m"
echo "before the gap:   max $before m"
echo "after the gap:    max $after m"

if near "$rmse" 0.225018 && near "$max" 2 && near "$before" 0 && near "$after" 0; then
  exit 0
fi
echo "changed: RMSE 0.225018 m and max 2 m were seen, and 0 m on both sides of the gap"
exit 1
