# Surfaces and classes of street scenes, each sequence labelled by models that did not see it.
title="Surfaces and classes of streets: CamVid"
s=$data/scene/camvid
[ -d "$s" ] || { absent "$title"; return 0; }
heading "$title"
rendered="--rendered 11,12,13 --rendered-frames 25" # as for the models that come with the program
command_line "placegraph train surfaces|urban \$DATA/scene/camvid --holdout SEQUENCE $rendered --ablation --out MODEL"
command_line "placegraph image surfaces|labels SEQUENCE --model MODEL --ids --confidence --out LABELS"
command_line "placegraph eval labels LABELS SEQUENCE [--surfaces]"

# labelled NAME FOLDER ARGUMENTS...: surfaces and classes of a folder, judged
labelled() {
  part=$out/camvid-$1; folder=$2; shift 2
  say "labelling $part"
  $placegraph image surfaces "$folder" --out "$part-surfaces" --ids --confidence --force --json ${1:+--model "$1"} > "$part-surfaces.json" 2> "$part.log"
  $placegraph image labels "$folder" --out "$part-urban" --ids --confidence --force --json ${1:+--model "$2" --surfaces-model "$1"} > "$part-urban.json" 2>> "$part.log"
  $placegraph eval labels "$part-surfaces" "$folder" --surfaces --json > "$part-surfaces.check.json"
  $placegraph eval labels "$part-urban" "$folder" --json > "$part-urban.check.json"
}
for sequence in 0001TP 0006R0 0016E5; do
  folder=$out/camvid-$sequence
  rm -rf "$folder"; mkdir -p "$folder/images" "$folder/labels"
  cp "$s/CLASSES.txt" "$folder/"
  for kind in images labels; do for f in "$s/train/$kind/$sequence"*; do ln -s "$f" "$folder/$kind/"; done; done
  for kind in surfaces urban; do
    [ -n "${REUSE_RUNS:-}" ] && [ -f "$folder.$kind.pgscene" ] && [ -f "$folder.$kind.json" ] && continue
    say "learning $kind without $sequence"
    $placegraph train $kind "$s" --holdout $sequence $rendered --out "$folder.$kind.pgscene" --ablation --force --json > "$folder.$kind.json" 2> "$folder.$kind.log"
  done
  labelled "$sequence" "$folder" "$folder.surfaces.pgscene" "$folder.urban.pgscene"
done
labelled val "$s/val" ""
for kind in surfaces urban; do
  prose "$([ $kind = surfaces ] && echo "Sky, ground, vertical, object" || echo "The eleven classes, by both models"); \`val\` by the models that come with the program:"
  columns held-out "pixel accuracy" "class accuracy" "mean IoU" "calibration error" "CPU an image [ms]"
  for part in 0001TP 0006R0 0016E5 val; do
    f=$out/camvid-$part-$kind.check.json
    cells "$part" "$(digits "$(number "$f" pixel_accuracy)")" "$(digits "$(number "$f" class_accuracy)")" "$(digits "$(number "$f" mean_iou)")" \
      "$(digits "$(number "$f" calibration_error)")" "$(digits "$(number "$out/camvid-$part-$kind.json" ms_per_picture)" 0)"
  done
done
# mean_of KIND KEY: over the sequences held out
mean_of() { for q in 0001TP 0006R0 0016E5; do number "$out/camvid-$q-$1.check.json" "$2"; done | LC_ALL=C awk '{ s += $1 } END { print s / NR }'; }
columns figure target measured met
target() { cells "$1" "$3 $4" "$(digits "$2")" "$(verdict "$2" "$3" "$4")"; }
target "surfaces, pixel accuracy, mean of the sequences held out" "$(mean_of surfaces pixel_accuracy)" ">=" 0.90
target "classes, pixel accuracy, mean of the sequences held out" "$(mean_of urban pixel_accuracy)" ">=" 0.80
target "classes, mean IoU, mean of the sequences held out" "$(mean_of urban mean_iou)" ">=" 0.38
target "surfaces, pixel accuracy, val" "$(number "$out/camvid-val-surfaces.check.json" pixel_accuracy)" ">=" 0.93
target "classes, pixel accuracy, val" "$(number "$out/camvid-val-urban.check.json" pixel_accuracy)" ">=" 0.85
target "classes, mean IoU, val" "$(number "$out/camvid-val-urban.check.json" mean_iou)" ">=" 0.45
target "calibration error of surfaces, mean of the sequences held out" "$(mean_of surfaces calibration_error)" "<=" 0.05
target "calibration error of classes, mean of the sequences held out" "$(mean_of urban calibration_error)" "<=" 0.05
target "CPU an image, both models, one thread [ms]" "$(number "$out/camvid-val-urban.json" ms_per_picture)" "<=" 250

prose 'What each part brings: pixel accuracy and mean IoU of the urban model alone on the sequence that was held out.'
columns part 0001TP 0006R0 0016E5
# step_of FILE PART KEY: of the report of --ablation
step_of() { awk -v part="\"$2\": {" -v key="\"$3\":" 'index($0, part) { on = 1 } on && index($0, key) { gsub(/[^0-9.]/, "", $2); print $2; exit }' "$1"; }
for part in "superpixels alone" "with context" "with two rounds of it" "with the random field" "with its relations"; do
  set -- "$part"
  for q in 0001TP 0006R0 0016E5; do
    f=$out/camvid-$q.urban.json
    set -- "$@" "$(digits "$(step_of "$f" "$part" pixel_accuracy)"), $(digits "$(step_of "$f" "$part" mean_iou)")"
  done
  cells "$@"
done
