# Lines followed over frames: motion from them alone and beside points.
title="Lines: motion without points"
s=$data/sequences
render corridor corridor-loop --difficulty standard --stereo --depth --frames 620
heading "$title"
command_line "placegraph synth sequence corridor-loop --out WORLD --difficulty standard --stereo --depth --frames 620"
command_line "placegraph run SEQUENCE --out OUT --sensor SENSOR --cues CUES --no-loops"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align ALIGN --lengths LENGTHS --step STEP"
prose << 'NOTE'
Nothing is fitted (`--align origin`). Errors are those of segments of 5,10,20,40 m, step 5, in the corridor and of
10,20,30,40,50 m, step 1, on KITTI. `RPE rot` is the median rotation error between frames, `CPU` the time of a frame.
NOTE
columns sequence sensor cues "posed frames" "ATE RMSE [m]" "t_rel [%]" "RPE rot [deg]" "CPU [ms]" "target met"
# line_row NAME SEQUENCE SENSOR CUES ALIGN LENGTHS STEP [LIMIT]
line_row() {
  run "$1" "$2" --sensor "$3" --cues "$4" --no-loops
  judge "$1" "$2" "$out/$1/trajectory_optimized.kitti" --align "$5" --lengths "$6" --step "$7"
  f=$out/$1.json; r=$out/$1/result.json
  met=-
  [ -z "${8:-}" ] || met="t_rel <= $8: $(verdict "$(number "$f" t_rel_percent)" "<=" "$8")"
  cells "$(basename "$2" | sed 's/^corridor-world$/corridor-loop/')" "$3" "$4" "$(number "$f" posed) of $(number "$r" frames)" \
    "$(digits "$(number "$f" ate_rmse_m)" 4)" "$(digits "$(number "$f" t_rel_percent)")" "$(digits "$(number "$f" rpe_rot_median_deg)" 4)" \
    "$(LC_ALL=C awk -v c="$(number "$r" cpu_s)" -v n="$(number "$r" frames)" 'BEGIN { printf "%.1f", 1000 * c / n }')" "$met"
}
for cues in lines points points,lines; do
  limit=; [ "$cues" != lines ] || limit=2
  line_row "corridor-stereo-$cues" "$out/corridor-world" stereo $cues origin 5,10,20,40 5 $limit
done
line_row corridor-mono-lines "$out/corridor-world" mono lines origin 5,10,20,40 5 2
line_row corridor-rgbd-lines "$out/corridor-world" rgbd lines origin 5,10,20,40 5 2
for cues in lines points points,lines; do
  [ ! -d "$s/kitti06_stereo51" ] || line_row "kitti06-$cues" "$s/kitti06_stereo51" stereo $cues origin 10,20,30,40,50 1
done
prose 'Associations by the true poses: an observation is wrong if it misses the line that most of its track shows by more than 3 px. Tracks of use are those seen in 3 frames or more.'
command_line "placegraph track lines SEQUENCE --sensor stereo"
columns sequence "tracks" "median length [frames]" "of use [frames]" observations "wrong [%]" "target met"
$placegraph track lines "$out/corridor-world" --sensor stereo --json > "$out/corridor-tracks.json"
f=$out/corridor-tracks.json
cells corridor-loop "$(number "$f" tracks)" "$(number "$f" median_length_frames)" "$(number "$f" median_length_of_use_frames)" "$(number "$f" sightings)" "$(digits "$(number "$f" wrong_percent)")" \
  "length >= 20: $(verdict "$(number "$f" median_length_frames)" ">=" 20); wrong <= 1 %: $(verdict "$(number "$f" wrong_percent)" "<=" 1)"
