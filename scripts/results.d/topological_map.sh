# The topological map and its loops on rendered drives, half size: all of KITTI 00, 05, 06 and 08,
# three times round one block, and a street of blocks that are the same. DRIVES="00 06" takes those
# alone: all four take most of an hour to render.
drives=${DRIVES:-00 05 06 08}
title="The topological map and its loops"
[ -d "$data/kitti_gt/00" ] || { absent "$title"; return 0; }
heading "$title"
command_line "placegraph synth sequence \$DATA/kitti_gt/NN/poses.txt --out WORLD --difficulty standard --mono --size 620x188"
command_line "placegraph synth sequence rounds.txt --out WORLD --difficulty standard --mono --size 620x188    # rounds of 316 m"
command_line "placegraph synth sequence repeated-blocks --out WORLD --difficulty standard --mono --size 620x188"
command_line "placegraph run WORLD --sensor mono --camera-height 1.65 --out OUT"
command_line "placegraph map export OUT --revisits known.txt"
command_line "placegraph match WORLD --sequence --min-age 300 --out found.txt"
command_line "placegraph loops --predictions known.txt|found.txt --true-poses WORLD/poses.txt --min-age 300 --json"

# half NAME WORLD: renders it, maps it, and recognizes its views
half() {
  render "half$1" "$2" --difficulty standard --mono --size 620x188
  run "half$1" "$out/half$1-world" --sensor mono --camera-height 1.65
  case $1 in 00|06)
    $placegraph map export "$out/half$1" --revisits "$out/half$1-known.txt" --force
    $placegraph loops --predictions "$out/half$1-known.txt" --true-poses "$out/half$1-world/poses.txt" --min-age 300 --json > "$out/half$1-known.json"
    say "matching half$1"
    $placegraph match "$out/half$1-world" --sequence --min-age 300 --out "$out/half$1.txt" --force > "$out/half$1-match.log" 2>&1
    $placegraph loops --predictions "$out/half$1.txt" --true-poses "$out/half$1-world/poses.txt" --min-age 300 --json > "$out/half$1-loops.json" ;;
  esac
}

write_rounds 3 "$out/rounds.txt"

for drive in $drives; do half $drive "$data/kitti_gt/$drive/poses.txt"; done
half rounds "$out/rounds.txt"
half blocks repeated-blocks

prose << 'NOTE'
`00` to `08` are whole KITTI drives, `rounds` goes three times round a block of 316 m, each round 0.3 m beside the last,
`blocks` has blocks that look the same. Figures are those of `place_check` and `loop_check` in `result.json`. Precision and recall are those of the
adjacency of places. `met`: at most 5 % of the revisited places added again, purity, precision and recall of at least 0.95, and no false loop.
NOTE
columns drive places "added by revisits" purity precision recall "loops, true" "loops, false" met
for drive in $drives rounds blocks; do
  f=$out/half$drive/result.json
  growth=$(number "$f" growth); purity=$(number "$f" purity)
  precision=$(number "$f" adjacency_precision); recall=$(number "$f" adjacency_recall); false=$(number "$f" false_loops)
  met=yes
  for check in "$growth <= 0.05" "$purity >= 0.95" "$precision >= 0.95" "$recall >= 0.95" "$false <= 0"; do
    set -- $check
    [ "$(verdict "$1" "$2" "$3")" = yes ] || met="**no**"
  done
  cells "$drive" "$(number "$f" places)" "$(number "$f" added_places) of $(number "$f" revisited_places) ($(computed %.1f "100 * $growth") %)" \
    "$(digits "$purity")" "$(digits "$precision")" "$(digits "$recall")" "$(number "$f" true_loops)" "$false" "$met"
done

gap
printf 'Places founded in the first, second and third round: ' >> "$rows"
awk '/"anchor_keyframe"/ { anchor = 1 } anchor && /"frame":/ { gsub(/[^0-9]/, ""); n[int($0 / 316)]++; anchor = 0 }
  END { printf "%d, %d, %d.\n", n[0], n[1], n[2] }' "$out/halfrounds/places.json" >> "$rows"

prose << 'NOTE'
Revisits (within 5 m and 30 deg of a view 300 frames older): as the finished map gives them, by the places first, then by
the distance of its poses; and by recognition alone, before any geometry.
NOTE
columns drive by revisits R@1 AP "recall at full precision" target met
for drive in 00 06; do
  for by in known loops; do
    f=$out/half$drive-$by.json; [ -f "$f" ] || continue
    recall=$(number "$f" recall_at_100p); name="the map"; [ $by = known ] || name="recognition alone"
    cells "$drive" "$name" "$(number "$f" positives)" "$(digits "$(number "$f" r_at_1)")" "$(digits "$(number "$f" ap)")" "$(digits "$recall")" ">= 0.95" "$(verdict "$recall" ">=" 0.95)"
  done
done
