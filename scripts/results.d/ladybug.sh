# Bundle adjustment of Ladybug.
title="Bundle adjustment: Ladybug, 49 cameras, 7776 points"
s=$data/bal/problem-49-7776-pre.txt
[ -f "$s" ] || { absent "$title"; return 0; }
say "adjusting Ladybug"
$placegraph graph bundle "$s" --json > "$out/ladybug.json"
heading "$title"
command_line "placegraph graph bundle \$DATA/bal/problem-49-7776-pre.txt --json"
table
f=$out/ladybug.json
cost=$(number "$f" cost)
row "half the sum of squares, no loss function [px^2]" - - - "<= 13344.25 (1 + 1e-4)" "$(digits "$cost" 4)" "$(verdict "$cost" "<=" 13345.584425)"
row "iterations / CPU [s]" - - - - "$(number "$f" iterations) / $(digits "$(LC_ALL=C awk -v ms="$(number "$f" cpu_ms)" 'BEGIN { print ms / 1000 }')" 1)" -
