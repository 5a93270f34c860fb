# Semantic maps of streets: rendered towns against their true scenes, before and after loops
# corrected them; the top view of a real street.
title="Semantic maps of streets"
heading "$title"
command_line "placegraph synth sequence town-loop --seed SEED --stereo --labels --frames 570 --out TOWN"
command_line "placegraph run TOWN --sensor stereo --config street_map --out OUT"
command_line "placegraph map street OUT --out MAP --set min_step_m=4 --set OPTIONS    # variants"
command_line "placegraph run \$DATA/sequences/kitti06_stereo51 --sensor stereo --config street_map --set scene.urban.labelling.step_px=4 --out OUT"
prose << 'NOTE'
`right`: the share of the known cells of 0.3 m whose class is present in the cell. `most surface`: the share whose
class has the most surface in it. `empty`: the share of cells with nothing within 0.5 m. `top view` is of the map seen
from above. Cells are compared in the frame
of the first pose, without alignment. `before` places the observations by the poses that each frame had when it was
done, `after` by those of the finished map with its loops. The models come with the program; they were trained on
photographs (CamVid) and on rendered towns of other seeds.
NOTE
columns world labels correction cells "right [%]" "most surface [%]" "empty [%]" "top view right [%]" target met
# score FILE CORRECTION GROUP FIELD
score() {
  awk -v when="\"$2\"" -v group="\"$3\"" -v field="\"$4\"" '
    index($0, "\"check\":") { on = 1 }
    on && index($0, when ":") { at = 1 }
    on && at && index($0, group ":") { inside = 1 }
    inside && index($0, field ":") { gsub(/[^0-9.e+-]/, "", $2); print $2; exit }' "$1"
}
percent() { awk -v v="$1" 'BEGIN { printf "%.1f", 100 * v }'; }
score_rows() { # score_rows FILE WORLD LABELS TARGET
  for when in online optimized; do
    case $when in online) said=before ;; *) said=after ;; esac
    right=$(percent "$(score "$1" $when all right_share)")
    case "$4" in -) met=- ;; *) met=$(verdict "$right" ">=" 90) ;; esac
    cells "$2" "$3" "$said" "$(score "$1" $when all cells)" "$right" "$(percent "$(score "$1" $when all most_share)")" \
      "$(percent "$(score "$1" $when all nothing_share)")" "$(percent "$(score "$1" $when top right_share)")" "$4" "$met"
  done
}
# another FILE LABELS OPTIONS...: the map of seed 1 made in another way
another() {
  file=$out/urban-$1.json; label=$2; shift 2
  if [ -z "${REUSE_RUNS:-}" ] || [ ! -s "$file" ]; then
    $placegraph map street "$out/urban-town-1" --out "$out/urban-other" --force --json --set min_step_m=4 "$@" \
      > "$file" 2> "$out/urban-other.log" || { cat "$out/urban-other.log" >&2; return 1; }
  fi
  score_rows "$file" "town-loop, seed 1" "$label" -
}
for seed in 1 5; do
  render "urban-town-$seed" town-loop --seed $seed --stereo --labels --frames 570
  run "urban-town-$seed" "$out/urban-town-$seed-world" --sensor stereo --config street_map
  score_rows "$out/urban-town-$seed/result.json" "town-loop, seed $seed" "as they are" ">= 90"
done
another apart "keyframes 4 m apart"
another flat "the same, without height and normal" --set labelling.geometry.weight=0
another residuals "the same, without residuals" --set residuals=false
another moving "the same, nothing dropped as moving" --set residuals=false --set 'labelling.moving=""'
s=$data/sequences/kitti06_stereo51
if [ -d "$s" ]; then
  run urban-kitti06 "$s" --sensor stereo --config street_map --set scene.urban.labelling.step_px=4
  mkdir -p docs/images
  cp "$out/urban-kitti06/semantic_map.png" docs/images/urban_map_kitti06.png
  picture "kitti06_stereo51 from above" urban_map_kitti06.png
fi
