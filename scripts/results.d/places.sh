# Place recognition: the benchmark against published figures, our recognition, and each cue alone.
title="Place recognition"
[ -d "$data/places" ] || { absent "$title"; return 0; }
heading "$title"
command_line "placegraph match FOLDER --out found.txt [--sequence] [--appearance CUES]    # kitchen: --min-age 34"
command_line "placegraph loops --predictions found.txt --truth FOLDER/gt.txt --json"
command_line "placegraph places classify \$DATA/places/vtm_virtual_house --out labels.txt [--sequence]"
command_line "placegraph loops --predictions found.txt --true-poses poses.txt --radius 0.5 --heading 30 --min-age 34 --json    # kitchen"
. scripts/results.d/place_sets.sh
# target NAME KEY LIMIT WHAT: a row
target() {
  value=$(number "$out/$1.json" "$2")
  cells "$4" "$2" ">= $3" "$(digits "$value")" "$(verdict "$value" ">=" "$3")"
}
for s in $sets; do
  found "places-$s" "$s"
  found "places-$s-sequence" "$s" --sequence
done
columns "set" figure target measured met
target places-corridor_milford r_at_1 0.93 "corridor_milford, single image"
target places-corridor_milford ap 0.88 "corridor_milford, single image"
target places-corridor_milford-sequence r_at_1 0.99 "corridor_milford, sequence"
target places-corridor_milford-sequence ap 0.98 "corridor_milford, sequence"
target places-corridor_milford-sequence recall_at_100p 0.60 "corridor_milford, sequence"
target places-gardens_day_thumb r_at_1 0.88 "gardens_day_thumb, single image"
target places-gardens_day_thumb ap 0.80 "gardens_day_thumb, single image"
target places-gardens_day_thumb-sequence r_at_1 0.96 "gardens_day_thumb, sequence"
target places-gardens_day_thumb-sequence ap 0.90 "gardens_day_thumb, sequence"
case "$sets" in *kitchen)
  for mode in "|single image" "-sequence|sequence"; do
    target "places-kitchen${mode%|*}" r_at_1 0.82 "7-Scenes kitchen, ${mode#*|}"
    target "places-kitchen${mode%|*}" ap 0.75 "7-Scenes kitchen, ${mode#*|}"
    target "places-kitchen${mode%|*}" recall_at_100p 0.40 "7-Scenes kitchen, ${mode#*|}"
  done ;;
esac
for n in 00 06; do
  case $n in 00) limits="0.818 0.870" ;; *) limits="0.814 0.814" ;; esac
  loops=$data/golden/loops
  [ -d "$loops" ] || continue
  $placegraph loops --predictions "$loops/ibow_KITTI${n}_loops.txt" --format ibow --truth "$loops/KITTI_${n}_loops_10m.txt" --json > "$out/places-ibow-$n.json"
  set -- recall_at_100p ap
  for limit in $limits; do
    value=$(number "$out/places-ibow-$n.json" "$1")
    cells "iBoW-LCD's published output, KITTI $n" "$1" "$limit +- .002" "$(digits "$value" 4)" \
      "$(verdict "$(computed %.6f "sqrt(($value - $limit) ^ 2)")" "<=" 0.002)"
    shift
  done
done

house=$data/places/vtm_virtual_house
if [ -d "$house" ]; then
  for mode in "|single image" "--sequence|sequence"; do
    $placegraph places classify "$house" --out "$out/places-labels.txt" --force ${mode%|*} > "$out/places-labels.log"
    value=$(classified_right "$out/places-labels.txt")
    cells "vtm_virtual_house, places classify, ${mode#*|}" accuracy ">= 0.985" "$(digits "$value")" "$(verdict "$value" ">=" 0.985)"
  done
fi

prose 'Each cue alone, all but one, and all, on single images: R@1 / AP / recall at full precision.'
columns cues $sets
for cues in tiny colour gradients gabor corners colour,gradients,gabor,corners tiny,gradients,gabor,corners tiny,colour,gabor,corners tiny,colour,gradients,corners tiny,colour,gradients,gabor tiny,colour,gradients,gabor,corners; do
  set --
  for s in $sets; do
    found places-cues "$s" --appearance "$cues"
    set -- "$@" "$(figures places-cues)"
  done
  cells "$cues" "$@"
done

frames=$data/sequences/sevenscenes_rgbd334/image_0
[ -d "$frames" ] || return 0
cmake --preset release -DPLACEGRAPH_BENCH=ON > "$out/configure.log"
cmake --build --preset release -j"$(nproc)" --target bench_place_study > "$out/places-build.log"
cmake --preset release -DPLACEGRAPH_BENCH=OFF > "$out/configure.log"
prose 'CPU time of an image of 640x480, medians (target: 12 ms with 10,000 views), and memory.'
command_line "bench_place_study \$DATA/sequences/sevenscenes_rgbd334/image_0 --plot docs/images/place_cost.png 1000 3000 10000 30000 100000"
gap
mkdir -p docs/images
build/release/tests/bench/bench_place_study "$frames" --plot docs/images/place_cost.png 1000 3000 10000 30000 100000 > "$out/places-cost.txt"
sed 's/^/    /' "$out/places-cost.txt" >> "$rows"
cost=$(sed -n 's/^ *10000 views: .* all \([0-9.]*\) ms$/\1/p' "$out/places-cost.txt")
picture "What recognizing a place costs, against the views stored" place_cost.png
columns figure target measured met
cells "whole place pipeline, 10,000 views [ms CPU an image]" "<= 12" "$cost" "$(verdict "$cost" "<=" 12)"

# The tiny image alone, among windows of 0.7 of the width; queries are larger, smaller or beside.
prose << 'NOTE'
Recall of the tiny image by its pyramid of scales and shifts / without it, against zoom and shift (share of the width).
NOTE
command_line "bench_place_study FOLDER --robustness"
set --
for s in $sets; do
  case $s in kitchen) images=$frames ;; *) images=$data/places/$s/images ;; esac
  build/release/tests/bench/bench_place_study "$images" --robustness |
    sed 's/^\(.*\): pyramid \(.*\), where it stands \(.*\)/\1|\2 \/ \3/' > "$out/robust-$s.txt"
  set -- "$@" "$out/robust-$s.txt"
done
columns query $sets
paste -d'|' "$@" | while IFS='|' read -r what one x two y three; do
  if [ -n "${three:-}" ]; then cells "$what" "$one" "$two" "$three"; else cells "$what" "$one" "$two"; fi
done
