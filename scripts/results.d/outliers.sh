# False loops: what is left of the map, what is rejected, and at which cost.
title="False loops"
[ -d "$data/posegraphs" ] || { absent "$title"; return 0; }
export OPENBLAS_NUM_THREADS=1

# edges FILE: "from to" of its edges
edges() { awk '/^EDGE/ { print $2, $3 }' "$1"; }
# rejections TRUE_GRAPH JSON: "true false": how many of the rejected edges are in the graph without false loops, and not
rejections() {
  edges "$1" > "$out/true-edges.txt"
  sed -nE 's/^ *"(from|to)": ([-0-9]+),?$/\2/p' "$2" | paste -d ' ' - - |
    awk -v file="$out/true-edges.txt" 'BEGIN { while ((getline line < file) > 0) is_true[line] = 1 }
      { if ($0 in is_true) lost++; else found++ } END { print lost + 0, found + 0 }'
}
# attack GRAPH N ORIGIN FILE RMSE_LIMIT LOST_LIMIT CPU_LIMIT
attack() {
  clean=$data/posegraphs/$1.g2o; case_=outliers-$1-$2-$3
  say "$1 with $2 false loops ($3)"
  $placegraph synth graph "$4" --shuffle -o "$out/$case_-shuffled.g2o" --force > "$out/$case_.log"
  optimize "$case_" "$out/$case_-shuffled.g2o" --robust auto
  f=$out/$case_.json
  if [ ! -f "$f" ]; then cells "$1" "$2" "$3" "no answer" "**no**" - - - - - - -; return 0; fi
  $placegraph graph convert "$out/$case_.g2o" "$out/$case_.kitti" --force > "$out/$case_.log"
  judge "$case_-rmse" "$out/outliers-$1-clean.kitti" "$out/$case_.kitti" --align se3
  rmse=$(number "$out/$case_-rmse.json" ate_rmse_m); ms=$(number "$f" cpu_ms)
  loops=$(edges "$clean" | awk '$2 - $1 != 1 && $1 - $2 != 1' | wc -l)
  rejected=$(rejections "$clean" "$f"); lost=${rejected% *}; found=${rejected#* }
  allowed=$(computed %d "$6 * $loops")
  cells "$1" "$2" "$3" "$(significant "$rmse" 3)" "<= $5" "$(verdict "$rmse" "<=" "$5")" "$lost of $loops" "<= $allowed" \
    "$(verdict "$lost" "<=" "$allowed")" "$(($2 - found))" "$(computed %.2f "$ms / 1000")" "<= $7" "$(verdict "$ms" "<=" "$(computed %d "1000 * $7")")"
}

heading "$title"
command_line "placegraph synth graph \$DATA/posegraphs/outliers/GRAPH_outN.g2o --shuffle -o IN.g2o    # published"
command_line "placegraph synth graph \$DATA/posegraphs/GRAPH.g2o --false-loops N --shuffle -o IN.g2o    # generated"
command_line "placegraph optimize IN.g2o -o OUT.g2o --robust auto --json"
command_line "placegraph optimize \$DATA/posegraphs/GRAPH.g2o -o CLEAN.g2o"
command_line "placegraph graph convert OUT.g2o OUT.kitti    # CLEAN.g2o likewise"
command_line "placegraph eval CLEAN.kitti OUT.kitti --align se3"
prose << 'NOTE'
`RMSE` is that of the positions against the optimum without false loops. `lost` counts the true loops that were
rejected, `kept` the false loops that were not. The false loops of `published` are those of the data set, those of
`generated` are drawn by `synth graph`.
NOTE
columns graph "false loops" source "RMSE [m]" target met lost target met kept "CPU [s]" target met
# graph, RMSE [m], share of true loops that may be lost, CPU [s]
echo "intel 0.01 0 2
kitti_00 0.1 0.05 2
sphere2500 0.01 0 20" | while read -r graph rmse_limit lost_limit cpu_limit; do
  optimize "outliers-$graph-clean" "$data/posegraphs/$graph.g2o"
  $placegraph graph convert "$out/outliers-$graph-clean.g2o" "$out/outliers-$graph-clean.kitti" --force > "$out/outliers-$graph-clean.log"
  for n in 10 100 1000; do
    attack $graph $n published "$data/posegraphs/outliers/${graph}_out$n.g2o" $rmse_limit $lost_limit $cpu_limit
    $placegraph synth graph "$data/posegraphs/$graph.g2o" --false-loops $n -o "$out/outliers-$graph-$n.g2o" --force > "$out/outliers-$graph-$n.log"
    attack $graph $n generated "$out/outliers-$graph-$n.g2o" $rmse_limit $lost_limit $cpu_limit
  done
done
