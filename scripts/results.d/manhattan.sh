# Rectangular worlds: motion with and without their directions, and directions in single images.
title="Directions of rectangular worlds"
s=$data/sequences
render corridor corridor-loop --difficulty standard --stereo --depth --frames 620
heading "$title"
command_line "placegraph synth corridor-loop --out WORLD --difficulty standard --stereo --depth --frames 620"
command_line "placegraph run SEQUENCE --out OUT --sensor SENSOR --cues CUES --no-loops"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align ALIGN --lengths LENGTHS --step STEP"
columns sequence sensor cues "posed frames" align "ATE RMSE [m]" "lengths [m], step" "t_rel [%]" "r_rel [deg/100 m]" "RPE rot median [deg]" "CPU a frame [ms]"
# direction_rows NAME SEQUENCE SENSOR ALIGN LENGTHS STEP: without and with the cue
direction_rows() {
  for cues in points,plane points,plane,manhattan; do
    run "$1-$cues" "$2" --sensor "$3" --cues "$cues" --no-loops
    judge "$1-$cues" "$2" "$out/$1-$cues/trajectory_optimized.kitti" --align "$4" --lengths "$5" --step "$6"
    f=$out/$1-$cues.json; r=$out/$1-$cues/result.json
    cells "$(basename "$2" | sed 's/^corridor-world$/corridor-loop/')" "$3" "$cues" "$(number "$f" posed) of $(number "$r" frames)" "$4" \
      "$(digits "$(number "$f" ate_rmse_m)" 4)" "$5, $6" "$(digits "$(number "$f" t_rel_percent)")" "$(digits "$(number "$f" r_rel_deg_per_100m)")" \
      "$(digits "$(number "$f" rpe_rot_median_deg)" 4)" \
      "$(LC_ALL=C awk -v c="$(number "$r" cpu_s)" -v n="$(number "$r" frames)" 'BEGIN { printf "%.1f", 1000 * c / n }')"
  done
}
for sensor in rgbd stereo mono; do
  direction_rows "corridor-$sensor" "$out/corridor-world" $sensor origin 5,10,20,40 5
done
[ ! -d "$s/sevenscenes_rgbd334" ] || for sensor in rgbd mono; do
  align=se3; [ $sensor = rgbd ] || align=sim3
  direction_rows "sevenscenes-$sensor" "$s/sevenscenes_rgbd334" $sensor $align 1,2,4 1
done
[ ! -d "$s/kitti06_stereo51" ] || direction_rows kitti06-stereo "$s/kitti06_stereo51" stereo se3 10,20,30,40,50 1
for clip in kitti00_mono200 kitti0095_mono268; do
  [ ! -d "$s/$clip" ] || direction_rows "$clip" "$s/$clip" mono sim3 10,20,30,40,50 1
done
york=$data/scene/york_urban_vp
[ -d "$york" ] || return 0
printf '\nSegments of single images (`york_urban_vp`) against vanishing points that people marked.\n\n' >> "$rows"
command_line "integration_vanishing_tests --gtest_filter='YorkUrban*'"
cmake --build --preset release -j2 --target integration_vanishing_tests > "$out/york-build.log"
PLACEGRAPH_DATA=$data build/release/tests/integration/integration_vanishing_tests --gtest_filter='YorkUrban*' > "$out/york.txt" || true
columns measure target measured "target met"
# figure PATTERN: the number that follows it
figure() { sed -n "s/.*$1 \([0-9.]*\).*/\1/p" "$out/york.txt" | head -1; }
york_row() { cells "$1" "$3 $4" "$(digits "$2" 3)" "$(verdict "$2" "$3" "$4")"; }
york_row "rotation error, median [deg]" "$(figure 'error median')" "<=" 1.5
york_row "rotation error, 95 % [deg]" "$(figure 'deg, 95 %')" "<=" 4
york_row "marked points found within 2 deg" "$(figure recall)" ">=" 0.85
york_row "false ones an image" "$(figure false)" "<=" 1
