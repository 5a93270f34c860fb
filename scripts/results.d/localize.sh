# New images placed in saved maps: a second traverse, another light, another place.
title="Localization: images of a second traverse in a saved map"
heading "$title"
command_line "placegraph map learn PLACES --range FIRST LAST --out map.db    # the candidates of gt.txt"
command_line "placegraph map localize map.db PLACES --range QUERIES --sequence --out placed.txt"
command_line "placegraph synth sequence HALF_OF_KITTI_00 --out WORLD --difficulty standard --stereo --size 620x188"
command_line "placegraph run WORLD --out MAP"
command_line "placegraph synth sequence HALF_OF_KITTI_00 --out OTHER --difficulty hard --mono --size 620x188"
command_line "placegraph map localize MAP OTHER --sequence --out placed.txt"
prose << 'NOTE'
KITTI 00 is rendered over its first 600 frames, every other one, and localized in images of other light. Images of the
corridor are in no map of the gardens: every one of them must be refused.
NOTE
columns "set" images "placed correctly [%]" ">= 95" "wrong [%]" "<= 1" refused "CPU [ms an image]"
# share NAME WHAT: of answers, from `right`, `wrong` and `refused` lines in $out/NAME.judged
judged() {
  awk -v what="$2" '{ n[$1]++; all++ } END { printf "%.2f", 100 * n[what] / all }' "$out/$1.judged"
}
placed_row() {
  right=$(judged "$1" right); wrong=$(judged "$1" wrong)
  # Most is asked of sequences: a single image may well be refused.
  enough=-; case "$1" in *--sequence) enough=$(verdict "$right" ">=" 95) ;; esac
  cells "$2" "$(awk 'END { print NR }' "$out/$1.judged")" "$right" "$enough" "$wrong" "$(verdict "$wrong" "<=" 1)" \
    "$(grep -c refused "$out/$1.judged")" "$(sed -n 's/.* refused.*, \([0-9.]*\) ms CPU.*/\1/p' "$out/$1.log")"
}
# by_list NAME GT: an answer is right if its view is among the matches listed
by_list() {
  awk '/^#/ { next } NR == FNR { for (i = 4; i <= NF; i++) match_of[$1, $i] = 1; next }
    $2 < 0 { print "refused"; next } { print match_of[$1, $3] ? "right" : "wrong" }' "$2" "$out/$1.txt" > "$out/$1.judged"
}
# by_pose NAME POSES_OF_MAP POSES_OF_IMAGES: right within 5 m and 30 deg of where the image was taken
by_pose() {
  awk 'FILENAME == ARGV[1] { for (i = 1; i <= 12; i++) a[FNR - 1, i] = $i; next }
    FILENAME == ARGV[2] { for (i = 1; i <= 12; i++) b[FNR - 1, i] = $i; next }
    /^#/ { next } $2 < 0 { print "refused"; next }
    { d = 0; for (i = 4; i <= 12; i += 4) d += (a[$3, i] - b[$1, i]) ^ 2
      t = 0; for (i = 1; i <= 11; i++) if (i % 4) t += a[$3, i] * b[$1, i]
      c = (t - 1) / 2; print (d <= 25 && c >= 0.8660254 ? "right" : "wrong") }' "$2" "$3" "$out/$1.txt" > "$out/$1.judged"
}
# place NAME MAP IMAGES ARGUMENTS...: $out/NAME.txt; exit code 1 says that none was placed
place() {
  name=$1; map=$2; images=$3; shift 3
  say "placing $name"
  $placegraph map localize "$map" "$images" --out "$out/$name.txt" --force "$@" > "$out/$name.log" 2>&1 || [ $? = 1 ]
}
for s in corridor_milford gardens_day_thumb; do
  folder=$data/places/$s
  [ -d "$folder" ] || { absent "$s"; continue; }
  set -- $(awk 'NR == 1 { first = $1; lo = $2; hi = $3 } { last = $1 } END { print lo, hi, first, last }' "$folder/gt.txt")
  $placegraph map learn "$folder" --range "$1" "$2" --out "$out/localize-$s.db" --force > "$out/localize-$s-learn.log" 2>&1
  for mode in "|single images" "--sequence|sequence"; do
    name=localize-$s${mode%|*}
    place "$name" "$out/localize-$s.db" "$folder" --range "$3" "$4" ${mode%|*}
    by_list "$name" "$folder/gt.txt"
    placed_row "$name" "$s, ${mode#*|}"
  done
done
poses=$data/kitti_gt/00/poses.txt
if [ -f "$poses" ]; then
  head -n 600 "$poses" | awk 'NR % 2 == 1' > "$out/half00.txt"
  render localize00 "$out/half00.txt" --difficulty standard --stereo --size 620x188
  render localize00-hard "$out/half00.txt" --difficulty hard --mono --size 620x188
  run localize00 "$out/localize00-world" --sensor stereo
  for mode in "|single images" "--sequence|sequence"; do
    place "localize00${mode%|*}" "$out/localize00" "$out/localize00-hard-world" ${mode%|*}
    by_pose "localize00${mode%|*}" "$out/localize00-world/poses.txt" "$out/localize00-hard-world/poses.txt"
    placed_row "localize00${mode%|*}" "KITTI 00 rendered, other light, ${mode#*|}"
    place "localize00-appearance${mode%|*}" "$out/localize00" "$out/localize00-hard-world" --set geometry=false ${mode%|*}
    by_pose "localize00-appearance${mode%|*}" "$out/localize00-world/poses.txt" "$out/localize00-hard-world/poses.txt"
    placed_row "localize00-appearance${mode%|*}" "KITTI 00 rendered, appearance alone, ${mode#*|}"
  done
fi
# Images of another place: every answer is wrong.
if [ -f "$out/localize-gardens_day_thumb.db" ] && [ -d "$data/places/corridor_milford" ]; then
  for mode in "|single images" "--sequence|sequence"; do
    name=localize-elsewhere${mode%|*}
    place "$name" "$out/localize-gardens_day_thumb.db" "$data/places/corridor_milford" ${mode%|*}
    awk '!/^#/ { print ($2 < 0 ? "refused" : "wrong") }' "$out/$name.txt" > "$out/$name.judged"
    cells "images of the corridor in the map of the gardens, ${mode#*|}" "$(awk 'END { print NR }' "$out/$name.judged")" - - \
      "$(judged "$name" wrong)" "$(verdict "$(judged "$name" wrong)" "<=" 1)" "$(grep -c refused "$out/$name.judged")" -
  done
fi
