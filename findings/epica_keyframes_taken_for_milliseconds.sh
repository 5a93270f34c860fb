#!/bin/sh
# epica 0.1.17 (PyPI), seen 2026-11-29.
#
# Input: a straight drive of 1 m/s. The truth has 10 Hz and 100 s (1000 poses). The estimate has a
# keyframe every 1.5 s (67 poses); each of its lines is a line of the truth. The stamps of both TUM
# files are seconds that begin at 0.
#
# Expected: `epa_ape tum` gives 0 m over 67 pairs. The stamps of the TUM format are seconds, and each
# keyframe has a true pose of the same stamp.
#
# Seen: "rmse=65.690220 m", "Aligned pairs: 2", and exit code 0. normalize_time_to_seconds() in
# core/math_utils.py guesses the unit of each file by the median step of its stamps: above 1 they are
# milliseconds. So 1.5 s become 1.5 ms, the whole drive takes 0.099 s, and its end is paired with the
# true pose of 0.1 s, 98.9 m away; only the start has the right partner. With keyframes every 0.9 s
# the result is right. With stamps of Unix time no pair is found, and epica says that.
#
# Instead: users interpolate slow keyframes to steps of at most 1 s, or compare by a tool that does not
# guess the unit: evo 1.38.1 gives 0 m for the same files. "Aligned pairs" shows the mistake.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check epica==0.1.17
export HOME="$dir" MPLBACKEND=Agg # epica keeps its settings there

env/bin/python - <<'PYTHON'
def write(name, every):
    with open(name, "w") as file:
        for i in range(0, 1000, every):
            file.write(f"{i / 10:.1f} {i / 10:.1f} 0 0 0 0 0 1\n")

write("truth.tum", 1)
write("slow.tum", 15)
write("quick.tum", 9)
PYTHON

number() { sed -n "s/.*$1\\([0-9.]*\\).*/\\1/p" "$2"; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[0-9]/ && a - b < 1e-3 && b - a < 1e-3) }'; }

for estimate in slow quick; do
  env/bin/epa_ape tum truth.tum $estimate.tum --out_dir $estimate >$estimate.txt
  echo "$estimate: $(number rmse= $estimate.txt) m over $(number 'pairs: ' $estimate.txt) pairs"
done

if near "$(number rmse= slow.txt)" 65.690220 && near "$(number 'pairs: ' slow.txt)" 2 &&
  near "$(number rmse= quick.txt)" 0 && near "$(number 'pairs: ' quick.txt)" 112; then
  exit 0
fi
echo "changed: 65.690220 m over 2 pairs (keyframes every 1.5 s), 0 m over 112 (0.9 s) were seen"
exit 1
