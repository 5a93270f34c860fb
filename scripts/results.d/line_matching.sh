# Segments matched between real pairs of views, against the groups that people marked.
title="Lines between two views: line_matching"
s=$data/scene/line_matching
[ -d "$s" ] || { absent "$title"; return 0; }
build_bench bench_pair_scores
heading "$title"
command_line "placegraph image match-lines \$DATA/scene/line_matching/PAIR/1.png .../2.png --segments .../lsd1.txt .../lsd2.txt --out MATCHES.txt"
command_line "build/release/tests/bench/bench_pair_scores lines \$DATA/scene/line_matching/PAIR/lsd_GroundTruthMatches.txt MATCHES.txt"
prose << 'NOTE'
`lsd`: with the segments of LSD; `ed`: with those of EDLines. Precision: the share of the matches that are among those
marked by people. Recall: the share of the groups (segments of one edge in either image) of which a match was found.
Recall of all pairs: the share of the marked pairs of segments that were found.
NOTE
columns pair segments groups matches precision recall "recall of all pairs"
for kind in lsd ed; do
  : > "$out/line_matching.$kind.precision"
  : > "$out/line_matching.$kind.recall"
  for folder in "$s"/*/; do
    pair=$(basename "$folder")
    first=$(ls "$folder" | grep -E '^(img)?1\.(png|jpg)$')
    second=$(ls "$folder" | grep -E '^(img)?[2-9]\.(png|jpg)$')
    number_b=$(echo "$second" | tr -dc '0-9')
    matches=$out/line_matching.$pair.$kind
    $placegraph image match-lines "$folder$first" "$folder$second" --segments "$folder${kind}1.txt" "$folder$kind$number_b.txt" \
      --out "$matches.txt" --force > "$matches.log"
    build/release/tests/bench/bench_pair_scores lines "$folder${kind}_GroundTruthMatches.txt" "$matches.txt" > "$matches.tsv"
    tabbed "$matches.tsv" precision >> "$out/line_matching.$kind.precision"
    tabbed "$matches.tsv" recall >> "$out/line_matching.$kind.recall"
    cells "$pair" "$kind" "$(tabbed "$matches.tsv" groups)" "$(tabbed "$matches.tsv" matches)" "$(digits "$(tabbed "$matches.tsv" precision)")" \
      "$(digits "$(tabbed "$matches.tsv" recall)")" "$(digits "$(tabbed "$matches.tsv" recall_pairs)")"
  done
done
columns figure segments target measured met
for kind in lsd ed; do
  pairs=$(wc -l < "$out/line_matching.$kind.precision")
  precision=$(median < "$out/line_matching.$kind.precision")
  recall=$(median < "$out/line_matching.$kind.recall")
  cells "precision, median of $pairs" "$kind" ">= 0.95" "$(digits "$precision")" "$(verdict "$precision" ">=" 0.95)"
  cells "recall, median of $pairs" "$kind" ">= 0.6" "$(digits "$recall")" "$(verdict "$recall" ">=" 0.6)"
done
