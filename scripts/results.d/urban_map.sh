# Maps of what is where in a street: rendered towns against their true scenes, before and after loops
# corrected them; the top view of a real street.
title="Semantic maps of streets"
heading "$title"
command_line "placegraph synth sequence town-loop --seed SEED --stereo --labels --frames 570 --out TOWN"
command_line "placegraph run TOWN --sensor stereo --config street_map --out OUT"
command_line "placegraph map street OUT --out MAP --set min_step_m=4 --set OPTIONS     # what each part brings"
command_line "placegraph run \$DATA/sequences/kitti06_stereo51 --sensor stereo --config street_map --set scene.urban.sight.step_px=4 --out OUT"
echo >> "$rows"
echo "Cells of 0.3 m whose class is one that truly stands there, of all that are known, by the first pose: nothing is fitted. \`before\`" >> "$rows"
echo "lays the sights out by the poses as they stood when each frame was done, \`after\` by those of the finished map, with its loops. The" >> "$rows"
echo "models are those that come with the program, learned from photographs (CamVid) and from rendered towns of other seeds." >> "$rows"
columns world labels correction cells "right [%]" "of most surface [%]" "nothing there [%]" "top view right [%]" target met
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
another flat "the same, without height and normal" --set sight.geometry.weight=0
another residuals "the same, without residuals" --set residuals=false
another moving "the same, nothing dropped as moving" --set residuals=false --set 'sight.moving=""'
s=$data/sequences/kitti06_stereo51
if [ -d "$s" ]; then
  run urban-kitti06 "$s" --sensor stereo --config street_map --set scene.urban.sight.step_px=4
  mkdir -p docs/images
  cp "$out/urban-kitti06/semantic_map.png" docs/images/urban_map_kitti06.png
  printf '\n![kitti06_stereo51 from above](images/urban_map_kitti06.png)\n' >> "$rows"
fi
