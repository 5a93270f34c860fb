# Runs with and without masks from labels of surfaces, on real and on rendered sequences.
title="Runs with and without masks from labels of surfaces"
heading "$title"
command_line "placegraph run SEQUENCE [--set semantics.enabled=true ...] --out OUT"
prose << 'NOTE'
The model is `configs/models/surfaces.pgscene`; the figures are those of `result.json`. `origin` fits nothing, so the
errors are metric; `sim3` fits a similarity, whose scale gives the scale error.
NOTE
columns sequence run posed keyframes "ATE [m] origin" "ATE [m] sim3" "scale error [%]" "t_rel [%]" "CPU [ms a frame]"
# scale_error NAME: of the similarity that fits best
masks_row() {
  f=$out/$2/result.json
  j=$out/$2.json
  cells "$1" "$3" "$(number "$f" posed)" "$(number "$f" keyframes)" \
    "$(digits "$(number "$j" ate_rmse_m)")" "$(digits "$(number "$out/$2-sim3.json" ate_rmse_m)")" \
    "$(computed %.2f "100 * ($(number "$out/$2-sim3.json" scale) - 1)")" \
    "$(digits "$(number "$j" t_rel_percent)")" \
    "$(computed %.1f "1000 * $(number "$f" cpu_s) / $(number "$f" frames)")"
}
# with_and_without NAME TITLE SEQUENCE LENGTHS ARGUMENTS...
with_and_without() {
  clip=$1; what=$2; of=$3; lengths=$4; shift 4
  for variant in none all still sky ground; do
    n=masks-$clip-$variant
    case $variant in
      none) run "$n" "$of" "$@" ;;
      all) run "$n" "$of" "$@" --set semantics.enabled=true ;;
      *)
        for part in sky moving ground; do
          [ "$part" = "$variant" ] || [ "$part-$variant" = moving-still ] || set -- "$@" --set "semantics.masks.$part=false"
        done
        run "$n" "$of" "$@" --set semantics.enabled=true
        for part in sky moving ground; do set -- "$@" --set "semantics.masks.$part=true"; done ;;
    esac
    judge "$n" "$of" "$out/$n/trajectory_optimized.kitti" --align origin --lengths "$lengths" --step 1
    judge "$n-sim3" "$of" "$out/$n/trajectory_optimized.kitti" --align sim3 --lengths "$lengths" --step 1
    case $variant in
      none) masks_row "$what" "$n" "no masks" ;;
      all) masks_row "$what" "$n" "sky, moving, ground" ;;
      still) masks_row "$what" "$n" "moving only" ;;
      *) masks_row "$what" "$n" "$variant only" ;;
    esac
  done
}
s=$data/sequences/kitti0095_mono268
if [ -d "$s" ]; then with_and_without k0095 "kitti0095_mono268, mono" "$s" 50,100,150,200 --sensor mono --camera-height 1.65; fi
s=$data/sequences/kitti06_stereo51
if [ -d "$s" ]; then
  with_and_without k06 "kitti06_stereo51, stereo" "$s" 10,20,30,40,50 --sensor stereo
  with_and_without k06m "kitti06_stereo51, left camera" "$s" 10,20,30,40,50 --sensor mono --camera-height 1.65
fi
frames=${MASKS_FRAMES:-150}
render traffic town-loop --difficulty hard --frames "$frames" --mono --seed 3
with_and_without traffic "town-loop seed 3, hard, $frames frames, mono" "$out/traffic-world" 50,100 --sensor mono --camera-height 1.65

# Places: twice round a block, with other traffic in either round.
write_rounds 2 "$out/masks-rounds.txt"
render masks-rounds "$out/masks-rounds.txt" --difficulty hard --mono --size 620x188
prose << 'NOTE'
Places recognized again: two rounds of a block of 316 m in hard traffic, monocular, at half size. The finished map gives
the revisits (within 5 m and 30 deg of a view that is 300 frames older).
NOTE
command_line "placegraph synth sequence rounds.txt --out WORLD --difficulty hard --mono --size 620x188"
command_line "placegraph run WORLD --sensor mono --camera-height 1.65 [--set semantics.enabled=true ...] --out OUT"
command_line "placegraph map export OUT --revisits known.txt"
command_line "placegraph loops --predictions known.txt --true-poses WORLD/poses.txt --min-age 300 --json"
columns run "loops, true" "loops, false" "loop candidates" "revisits, R@1" AP "recall at full precision" "ATE [m] origin"
# places_row NAME TITLE ARGUMENTS...
places_row() {
  n=masks-rounds-$1; what=$2; shift 2
  run "$n" "$out/masks-rounds-world" --sensor mono --camera-height 1.65 "$@"
  $placegraph map export "$out/$n" --revisits "$out/$n-known.txt" --force
  $placegraph loops --predictions "$out/$n-known.txt" --true-poses "$out/masks-rounds-world/poses.txt" --min-age 300 --json > "$out/$n-known.json"
  judge "$n" "$out/masks-rounds-world" "$out/$n/trajectory_optimized.kitti" --align origin
  f=$out/$n/result.json; j=$out/$n-known.json
  cells "$what" "$(number "$f" true_loops)" "$(number "$f" false_loops)" "$(awk 'END { print NR - 1 }' "$out/$n/loops.csv")" \
    "$(digits "$(number "$j" r_at_1)")" "$(digits "$(number "$j" ap)")" "$(digits "$(number "$j" recall_at_100p)")" "$(digits "$(number "$out/$n.json" ate_rmse_m)")"
}
only="--set semantics.enabled=true --set semantics.masks.ground=false"
places_row none "no masks"
places_row sky "sky only" $only --set semantics.masks.moving=false
places_row moving "moving only" $only --set semantics.masks.sky=false
places_row both "sky, moving" $only
places_row all "sky, moving, ground" --set semantics.enabled=true
