# Runs that are killed at random moments and go on from what they had saved.
title="A run killed 20 times (kill -9) and resumed from its saved map"
render kill town-loop --frames 200 --difficulty standard --stereo --size 620x188
heading "$title"
command_line "placegraph synth sequence town-loop --frames 200 --difficulty standard --stereo --size 620x188 --out WORLD"
command_line "scripts/kill_study placegraph WORLD OUT 20 7"
say "killing 20 runs"
scripts/kill_study "$placegraph" "$out/kill-world" "$out/kill" 20 7 > "$out/kill.txt" 2> "$out/kill.err" || cat "$out/kill.err" >&2
whole=$(awk '$1 == 0 { print $9 }' "$out/kill.txt")
prose 'A row is a run that was killed after so many seconds, and what it reached when it was resumed.'
columns "round" "killed after [s]" "frames saved" "places saved" posed places loops "ATE RMSE [m]" "over the whole run"
awk -v whole="$whole" '{ printf "| %s | %s | %s | %s | %s of %s | %s | %s | %.4f | %.2f |\n",
  $1 == 0 ? "whole" : $1, $2, $3, $4, $5, $6, $7, $8, $9, $9 / whole }' "$out/kill.txt" >> "$rows"
columns figure target measured met
ended=$(awk '$1 > 0 { n++ } END { print n + 0 }' "$out/kill.txt")
cells "maps opened, validated and resumed to the end" 20 "$ended" "$(verdict "$ended" = 20)"
lost=$(awk '{ n += $6 - $5 } END { print n + 0 }' "$out/kill.txt")
cells "frames without a pose" 0 "$lost" "$(verdict "$lost" = 0)"
worst=$(awk -v whole="$whole" '$1 > 0 && $9 / whole > w { w = $9 / whole } END { printf "%.3f", w }' "$out/kill.txt")
cells "largest ATE RMSE, over that of the whole run" "<= 2" "$worst" "$(verdict "$worst" "<=" 2)"
f=$out/kill/whole/result.json
cost_ms=$(awk -v frames="$(number "$f" frames)" '/"cpu_s"/ { s = $2 + 0 } /"name": "map database"/ { printf "%.3f", 1000 * s / frames }' "$f")
cells "commits [ms CPU a frame]" "< 2" "$cost_ms" "$(verdict "$cost_ms" "<=" 2)"
gap
printf '%s bytes of map for %s frames.\n' "$(wc -c < "$out/kill/whole/map.db")" "$(number "$f" frames)" >> "$rows"
