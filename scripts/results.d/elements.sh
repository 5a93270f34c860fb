# Every combination of the elements of navigation, with what each brings and what only two together do.
# ELEMENTS_FRAMES (150) says how long the clips are, ELEMENTS_ROUND (620) that of the corridor, which
# comes round and so has places to recognize; ELEMENTS_WORLDS which are run.
frames=${ELEMENTS_FRAMES:-150}
round=${ELEMENTS_ROUND:-620}
worlds=${ELEMENTS_WORLDS:-town corridor k0095}
title="Elements: every combination on a rendered town, a rendered corridor and a real drive"
heading "$title"
command_line "ELEMENTS_FRAMES=$frames ELEMENTS_ROUND=$round ELEMENTS_WORLDS=\"$worlds\" scripts/results elements"
command_line "placegraph run SEQUENCE --scene none --elements motion[,spatial][,geometry][,context][,semantics] --out OUT"
# places_labelled FILE KIND: share of the places of a run labelled as what they are [%]
places_labelled() {
  right=$(number "$1" "$2"); all=$(number "$1" places)
  [ -n "$right" ] && computed %.0f "100 * $right / $all" || echo 0
}
# ate ALIGN FILE: of the optimized trajectory, as a run judges itself
ate() { awk -v mark="\"$1\": {" 'index($0, mark) { on = 1 } on && /"ate_rmse_m"/ { gsub(/[^-+0-9.eE]/, "", $2); print $2; exit }' "$2"; }
# combinations NAME TITLE SEQUENCE KIND ARGUMENTS...
combinations() {
  clip=$1; what=$2; of=$3; kind=$4; shift 4
  table_file=$out/elements-$clip.txt
  : > "$table_file"
  heading "$what"
  columns elements posed loops "ATE [m] sim3" "ATE [m] origin" "places labelled $kind [%]" "CPU [ms a frame]"
  for bits in 0000 1000 0100 0010 0001 1100 1010 1001 0110 0101 0011 1110 1101 1011 0111 1111; do
    list=motion
    i=1
    for element in spatial geometry context semantics; do
      [ "$(echo "$bits" | cut -c$i)" = 0 ] || list=$list,$element
      i=$((i + 1))
    done
    n=elements-$clip-$bits
    run "$n" "$of" "$@" --elements "$list" --scene none
    f=$out/$n/result.json
    a=$(ate sim3 "$f"); b=$(ate origin "$f")
    loops=$(number "$f" loops_accepted); labelled=$(places_labelled "$f" "$kind")
    cells "$list" "$(number "$f" posed)" "$loops" "$(digits "$a" 4)" "$(digits "$b" 4)" "$labelled" \
      "$(computed %.0f "1000 * $(number "$f" cpu_s) / $(number "$f" frames)")"
    echo "$bits $a $loops $labelled $b" >> "$table_file"
  done
  prose << 'NOTE'
Effects: of one element, the figure with it less that without it, as a mean over all combinations of the others; of
two, half of what the effect of the one gains by the other. Less ATE is better.
NOTE
  columns element "ATE sim3 [m]" "ATE origin [m]" loops "places labelled [%]"
  LC_ALL=C awk '
    { for (k = 2; k <= 5; k++) v[$1, k] = $k; bits[NR] = $1 }
    # sign of a term in a two-level factorial design
    function sign(b, i) { return substr(b, i, 1) == "1" ? 1 : -1 }
    END {
      split("spatial geometry context semantics", name, " ")
      for (i = 1; i <= 4; i++) for (j = i; j <= 4; j++) {
        for (k = 2; k <= 5; k++) {
          e[k] = 0
          for (n = 1; n <= NR; n++) e[k] += v[bits[n], k] * sign(bits[n], i) * (i == j ? 1 : sign(bits[n], j))
          e[k] /= NR / 2
        }
        line[i, j] = sprintf("| %s | %+.4f | %+.4f | %+.2f | %+.1f |", (i == j ? name[i] : name[i] " with " name[j]), e[2], e[5], e[3], e[4])
      }
      for (i = 1; i <= 4; i++) print line[i, i]
      for (i = 1; i <= 4; i++) for (j = i + 1; j <= 4; j++) print line[i, j]
    }' "$table_file" >> "$rows"
}
for world in $worlds; do
  case $world in
    town)
      render elements-town town-loop --difficulty standard --frames "$frames" --mono
      combinations town "Town-loop, $frames frames, monocular, camera height 1.65 m" "$out/elements-town-world" street --sensor mono --camera-height 1.65 ;;
    corridor)
      render elements-round corridor-loop --difficulty standard --depth --mono --frames "$round"
      combinations round "Corridor-loop, $round frames, RGB-D" "$out/elements-round-world" corridor --sensor rgbd ;;
    k0095)
      s=$data/sequences/kitti0095_mono268
      [ -d "$s" ] || continue
      combinations k0095 "kitti0095_mono268, its first $frames frames, monocular, camera height 1.65 m" "$s" street --sensor mono --camera-height 1.65 --set max_frames="$frames" ;;
  esac
done
