# Orientation maps of single images against the surfaces that were rendered.
title="Orientation maps"
heading "$title"
command_line "placegraph synth sequence corridor-loop --seed SEED --difficulty DIFFICULTY --labels --mono --out WORLD"
command_line "placegraph image orientation WORLD --every 10"
prose << 'NOTE'
Coverage: the share of the pixels that get an orientation. Right of those: the share of them whose orientation is that of
the rendered surface.
NOTE
columns world images "CPU [ms an image]" "coverage [%]" ">= 60" "right of those [%]" ">= 88"
for world in "corridor-loop 1 standard" "corridor-loop 7 hard" "warehouse 1 standard"; do
  set -- $world
  name=orientation-$1-$2
  render "$name" "$1" --seed "$2" --difficulty "$3" --labels --mono --frames 600
  $placegraph image orientation "$out/$name-world" --every 10 --json > "$out/$name.json"
  share() { awk -v v="$(number "$out/$name.json" "$1")" 'BEGIN { printf "%.1f", 100 * v }'; }
  coverage=$(share coverage); right=$(share accuracy)
  met60=-; met88=-
  case "$1" in corridor*) met60=$(verdict "$coverage" ">=" 60); met88=$(verdict "$right" ">=" 88) ;; esac
  cells "$1, seed $2, $3" "$(number "$out/$name.json" images)" "$(digits "$(number "$out/$name.json" cpu_ms)" 0)" \
    "$coverage" "$met60" "$right" "$met88"
done
