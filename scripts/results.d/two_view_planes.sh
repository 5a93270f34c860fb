# Planes behind the matches of two views, against those that people marked.
title="Planes of two views: adelaide_planes"
s=$data/scene/adelaide_planes
[ -d "$s" ] || { absent "$title"; return 0; }
build_bench bench_pair_scores
heading "$title"
command_line "placegraph image two-view-planes \$DATA/scene/adelaide_planes/PAIR.txt --out LABELS.txt"
command_line "build/release/tests/bench/bench_pair_scores planes \$DATA/scene/adelaide_planes/PAIR.txt LABELS.txt"
prose << 'NOTE'
Misclassified: the share of the matches whose label differs from that given by people, under the best one-to-one
assignment of the labels. Outliers are one of the labels.
NOTE
columns pair matches "planes marked" "planes found" "misclassified [%]"
: > "$out/two_view_planes.values"
for file in "$s"/*.txt; do
  pair=$(basename "$file" .txt)
  labels=$out/two_view_planes.$pair
  $placegraph image two-view-planes "$file" --out "$labels.txt" --force --json > "$labels.json"
  build/release/tests/bench/bench_pair_scores planes "$file" "$labels.txt" > "$labels.tsv"
  wrong=$(tabbed "$labels.tsv" misclassified_percent)
  echo "$wrong" >> "$out/two_view_planes.values"
  cells "$pair" "$(tabbed "$labels.tsv" matches)" "$(tabbed "$labels.tsv" planes)" "$(sort -rn "$labels.txt" | head -n 1)" "$(digits "$wrong" 1)"
done
middle=$(median < "$out/two_view_planes.values")
columns figure target measured met
cells "misclassified, median of $(wc -l < "$out/two_view_planes.values") pairs [%]" "<= 10" "$(digits "$middle" 1)" "$(verdict "$middle" "<=" 10)"
