# Whether the errors of the edges of the place graph agree with their covariances: rendered sequences, each cue.
title="Edges of the place graph against the truth"
heading "$title"
command_line "placegraph run WORLD --sensor SENSOR --cues CUES --no-loops --out OUT"
command_line "placegraph eval edges WORLD OUT --json"
prose << 'NOTE'
NEES is that of the odometry edges per degree of freedom, 1 where the stated covariances are right; 1 % of the edges then
lie beyond the 99 % bound. `stereo06` is rendered along the path of KITTI 06, `town200` are the first 200 frames of
`town-loop`, `corridor` the first 620 of `corridor-loop`, all of the standard difficulty.
NOTE
columns sequence sensor cues edges "mean NEES" "median NEES" "beyond 99 % [%]" "mean in [0.5, 2]" "beyond <= 3 %"
# consistency_row NAME WORLD SENSOR CUES
consistency_row() {
  run "$1" "$out/$2-world" --sensor "$3" --cues "$4" --no-loops
  f=$out/$1.edges.json
  $placegraph eval edges "$out/$2-world" "$out/$1" --json > "$f"
  mean=$(number "$f" mean_nees)
  beyond=$(LC_ALL=C awk -v b="$(number "$f" share_beyond_99)" 'BEGIN { printf "%.1f", 100 * b }')
  in_range=$(verdict "$mean" ">=" 0.5); [ "$in_range" != yes ] || in_range=$(verdict "$mean" "<=" 2)
  cells "$2" "$3" "$4" "$(number "$f" edges)" "$(digits "$mean" 2)" "$(digits "$(number "$f" median_nees)" 2)" "$beyond" \
    "$in_range" "$(verdict "$beyond" "<=" 3)"
}
s=$data/kitti_gt/06/poses.txt
if [ -f "$s" ]; then
  render stereo06 "$s" --difficulty standard --stereo
  for cues in points points,plane,direct; do consistency_row "consistency-06-$cues" stereo06 stereo $cues; done
fi
render town200 town-loop --difficulty standard --frames 200
for cues in points lines plane direct; do consistency_row "consistency-town-$cues" town200 stereo $cues; done
consistency_row "consistency-town-mono" town200 mono points,plane  # of known height: the world's own
render corridor corridor-loop --difficulty standard --stereo --depth --frames 620
for cues in points lines points,lines,plane,manhattan; do consistency_row "consistency-corridor-$cues" corridor stereo $cues; done
for cues in points lines; do consistency_row "consistency-corridor-rgbd-$cues" corridor rgbd $cues; done
