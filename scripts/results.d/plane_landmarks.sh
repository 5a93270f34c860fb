# Plane landmarks: the same runs with and without them.
title="Planes as landmarks"
heading "$title"
command_line "placegraph synth sequence corridor-loop --difficulty standard --stereo --depth --frames 620 --out WORLD    # seed 1"
command_line "placegraph synth sequence corridor-loop --seed 7 --difficulty hard --mono --depth --frames 400 --out WORLD"
command_line "placegraph run SEQUENCE --sensor rgbd [--no-loops] --set odometry.planes.enabled=WITH --out OUT"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align se3"
command_line "placegraph eval edges SEQUENCE OUT --json    # without loops"
prose << 'NOTE'
Each pair of columns is a run without and with plane landmarks. Rendered depth is exact up to its steps of 1 mm. NEES is
that of the odometry edges per degree of freedom, 1 where the stated covariances are right; 1 % of the edges then lie
beyond the 99 % bound. CPU is the time of a frame.
NOTE
columns sequence sensor loops "ATE without [m]" "with [m]" "RPE rot median without [deg]" "with [deg]"
rest=$out/plane-landmarks-rest.md  # the second half of each row
: > "$rest"
# plane_row SEQUENCE-NAME SEQUENCE SENSOR LOOPS
plane_row() {
  loops=; [ "$4" = on ] || loops=--no-loops
  for with in false true; do
    n=planes-$1-$3-$4-$with
    run "$n" "$2" --sensor "$3" $loops --set "odometry.planes.enabled=$with"
    judge "$n" "$2" "$out/$n/trajectory_optimized.kitti" --align se3
    [ "$4" = on ] || $placegraph eval edges "$2" "$out/$n" --json > "$out/$n.edges.json"
  done
  a=$out/planes-$1-$3-$4-false; b=$out/planes-$1-$3-$4-true
  set -- "$1" "$3" "$4"
  first="$1 | $2 | $3"
  for of in "ate_rmse_m 4" "rpe_rot_median_deg 4"; do
    set -- "$@" "$(digits "$(number "$a.json" "${of% *}")" "${of#* }")" "$(digits "$(number "$b.json" "${of% *}")" "${of#* }")"
  done
  cells "$@"
  loops=$3
  set -- "$first"
  if [ "$loops" = on ]; then set -- "$@" - - - -; else
    set -- "$@" "$(digits "$(number "$a.edges.json" mean_nees)" 2)" "$(digits "$(number "$b.edges.json" mean_nees)" 2)"
    for f in "$a" "$b"; do
      set -- "$@" "$(LC_ALL=C awk -v s="$(number "$f.edges.json" share_beyond_99)" 'BEGIN { printf "%.1f", 100 * s }')"
    done
  fi
  for f in "$a" "$b"; do
    set -- "$@" "$(LC_ALL=C awk -v c="$(number "$f/result.json" cpu_s)" -v n="$(number "$f/result.json" frames)" 'BEGIN { printf "%.1f", 1000 * c / n }')"
  done
  { printf '| %s ' "$@"; echo "|"; } >> "$rest"
}
s=$data/sequences/sevenscenes_rgbd334
if [ -d "$s" ]; then
  for loops in on off; do plane_row sevenscenes_rgbd334 "$s" rgbd $loops; done
fi
render corridor corridor-loop --difficulty standard --stereo --depth --frames 620
for loops in on off; do plane_row corridor-seed-1-standard "$out/corridor-world" rgbd $loops; done
render planes7 corridor-loop --seed 7 --difficulty hard --mono --depth --frames 400
plane_row corridor-seed-7-hard "$out/planes7-world" rgbd off
columns sequence sensor loops "mean NEES without" with "beyond without [%]" "with [%]" "CPU without [ms]" "with [ms]"
cat "$rest" >> "$rows"
