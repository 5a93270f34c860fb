# What each cue is worth: alone, left out, and together.
title="Cues: each alone, each left out, and all together"
s=$data/sequences
heading "$title"
command_line "placegraph run SEQUENCE --sensor SENSOR --cues CUES --no-loops --out OUT [--camera-height 1.65]"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align ALIGN --lengths LENGTHS --step STEP"
prose << 'NOTE'
A cell is ATE RMSE [m] / t_rel [%] / CPU [ms a frame]. ALIGN is `se3` for kitti06_stereo51 and sevenscenes_rgbd334, else
`origin`, which fits nothing. Lengths: 10,...,50 m, step 1, on KITTI; 5,10,20 m, step 5, in the corridor; 10,20,40,80 m,
step 5, in the town; 0.5,1,2 m, step 1, on sevenscenes_rgbd334. `-`: the run says that the cues cannot stand alone. A
number in brackets: only so many frames have a pose. `direct` aligns several planes by their intensities, `points` is
indirect odometry. Without `plane` a monocular map has no scale, unless `direct` or lines on the floor give it one: its
error is then that of its scale.
NOTE
render corridor300 corridor-loop --difficulty standard --stereo --frames 300
render town200 town-loop --difficulty standard --frames 200
# cue_cell SEQUENCE SENSOR CUES ALIGN LENGTHS STEP ARGUMENTS...: the cell in $cell
cue_cell() {
  sequence=$1 sensor=$2 cues=$3 align=$4 lengths=$5 step=$6
  shift 6
  cell=-
  name=ablation-$(basename "$sequence")-$sensor-$cues
  if ! run "$name" "$sequence" --sensor "$sensor" --cues "$cues" --no-loops "$@" 2> "$out/$name.err"; then
    grep -q 'cues' "$out/$name.err" || { cat "$out/$name.err" >&2; return 1; }
    return 0
  fi
  r=$out/$name/result.json
  if judge "$name" "$sequence" "$out/$name/trajectory_optimized.kitti" --align "$align" --lengths "$lengths" --step "$step" 2> /dev/null; then
    f=$out/$name.json
    cell="$(digits "$(number "$f" ate_rmse_m)") / $(digits "$(number "$f" t_rel_percent)" 2) / $(digits "$(LC_ALL=C awk -v c="$(number "$r" cpu_s)" -v n="$(number "$r" frames)" 'BEGIN { print 1000 * c / n }')" 0)"
    [ "$(number "$f" posed)" = "$(number "$r" frames)" ] || cell="$cell ($(number "$f" posed))"
  else
    cell="(0)"
  fi
}
columns cues "kitti00_mono200, mono" "kitti0095_mono268, mono" "kitti06_stereo51, stereo"
rest=$out/ablation-rest.md  # the second half of each row
: > "$rest"
for cues in points plane lines direct points,plane points,lines points,lines,plane,manhattan,direct \
  lines,plane,manhattan,direct points,plane,manhattan,direct points,lines,manhattan,direct points,lines,plane,direct points,lines,plane,manhattan; do
  of_row=
  for sequence in kitti00_mono200 kitti0095_mono268; do
    cell=absent
    [ ! -d "$s/$sequence" ] || cue_cell "$s/$sequence" mono $cues origin 10,20,30,40,50 1 --camera-height 1.65
    of_row="$of_row|$cell"
  done
  cell=absent; [ ! -d "$s/kitti06_stereo51" ] || cue_cell "$s/kitti06_stereo51" stereo $cues se3 10,20,30,40,50 1
  echo "| $cues$(echo "$of_row|$cell" | sed 's/|/ | /g') |" >> "$rows"
  cell=absent; [ ! -d "$s/sevenscenes_rgbd334" ] || cue_cell "$s/sevenscenes_rgbd334" rgbd $cues se3 0.5,1,2 1
  of_row="|$cell"
  cue_cell "$out/corridor300-world" stereo $cues origin 5,10,20 5
  of_row="$of_row|$cell"
  cue_cell "$out/town200-world" stereo $cues origin 10,20,40,80 5
  echo "| $cues$(echo "$of_row|$cell" | sed 's/|/ | /g') |" >> "$rest"
done
columns cues "sevenscenes_rgbd334, RGB-D" "corridor, 300 frames, stereo" "town, 200 frames, stereo"
cat "$rest" >> "$rows"
