# What a run decides of loop candidates: probabilities against the truth, and what lines and two
# views bring. The coefficients of the probabilities were fitted to two rounds of a block, the
# corridor and the warehouse of seed 7 and the street of equal blocks (tests/bench/loop_probability_study); judged on others.
title="Loop decisions"
heading "$title"
command_line "placegraph synth sequence corridor-loop --out WORLD --seed 1 --difficulty standard    # warehouse likewise"
command_line "placegraph run WORLD --sensor rgbd|mono [--cues points,lines] --out OUT"
command_line "placegraph loops --predictions OUT/loops.csv --format run --true-poses WORLD/poses.txt --radius 1 --heading 40 --min-age 40 --json"

render "loops-corridor" corridor-loop --seed 1 --difficulty standard --size 320x240
render "loops-warehouse" warehouse --seed 1 --difficulty standard --size 320x240

columns sequence sensor cues accepted "by two views" "with lines" false candidates "off by" "met (<= .10)"
# decisions NAME FOLDER SENSOR CUES RADIUS
decisions() {
  name=loops-$1-$3-$(echo "$4" | tr , _)
  run "$name" "$2" --sensor "$3" --cues "$4"
  $placegraph loops --predictions "$out/$name/loops.csv" --format run --true-poses "$2/poses.txt" --radius "$5" --heading 40 --min-age 40 --json > "$out/$name-loops.json"
  set -- "$1" "$3" "$4" "$out/$name/loops.csv" "$out/$name"
  accepted=$(awk -F, '$5 == "accepted" { n++ } END { print n + 0 }' "$4")
  views=$(awk -F, '$5 == "accepted" && $6 != "3d2d" { n++ } END { print n + 0 }' "$4")
  lines=$(awk -F, '$5 == "accepted" && $7 > 0 { n++ } END { print n + 0 }' "$4")
  off=$(number "$5-loops.json" calibration_error)
  cells "$1" "$2" "$3" "$accepted" "$views" "$lines" "$(number "$5/result.json" false_loops)" "$(number "$5-loops.json" candidates)" "$(digits "$off")" "$(verdict "$off" "<=" 0.1)"
}
for cues in points points,lines; do
  for sensor in rgbd mono; do
    decisions corridor "$out/loops-corridor-world" $sensor $cues 1
    decisions warehouse "$out/loops-warehouse-world" $sensor $cues 1
  done
  if [ -d "$data/sequences/sevenscenes_rgbd334" ]; then
    decisions sevenscenes "$data/sequences/sevenscenes_rgbd334" rgbd $cues 0.5
  fi
done
prose << 'NOTE'
Of the accepted loops: `by two views`, those whose pose comes from two views; `with lines`, those that lines support;
`false`, those more than 0.1 m or 5 deg off, where the scale is known. `off by` is the calibration error of the loop
probabilities: over the candidates, in tenths of probability, the mean difference between the probability and the share
that truly lies within the radius (1 m, in sevenscenes 0.5 m) and 40 deg.
NOTE
