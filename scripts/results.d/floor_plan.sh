# Floor plans of rendered buildings against their true ones.
title="Floor plans"
heading "$title"
command_line "placegraph synth sequence WORLD --seed SEED --difficulty DIFFICULTY --stereo --out SEQUENCE"
command_line "placegraph run SEQUENCE --sensor SENSOR --config floor_plan --out OUT    # mono: --camera-height 1.4"
prose << 'NOTE'
The plan is compared in the frame of the first pose, without alignment. Walls: median distance from the surfaces of the
true walls that the poses can have seen to the walls of the plan; plan: from the walls of the plan to true ones. Room
IoU: the least intersection over union of the rooms that were entered.
NOTE
columns world sensor "walls [cm]" "plan [cm]" target met "room IoU" ">= .85" "doors found" ">= 80 %" "false doors"
plan_row() {
  f=$out/$1/result.json; limit=5; case "$3" in mono) limit=15 ;; esac
  if ! grep -q '"wall_error_median_m"' "$f"; then
    cells "$2" "$3" "none" "none" "<= $limit" "**no**" "none" "**no**" "none" "**no**" "-"
    return 0
  fi
  get() { number "$f" "$1"; }  # the first of each is by the first pose
  walls=$(awk -v v="$(get wall_error_median_m)" 'BEGIN { printf "%.1f", 100 * v }')
  back=$(awk -v v="$(get plan_error_median_m)" 'BEGIN { printf "%.1f", 100 * v }')
  worse=$(printf '%s\n%s\n' "$walls" "$back" | sort -g | tail -1)
  iou=$(get room_iou_least); found=$(get doors_found); seen=$(get doors_seen)
  share=$(awk -v a="$found" -v b="$seen" 'BEGIN { printf "%.1f", (b > 0 ? 100 * a / b : 0) }')
  cells "$2" "$3" "$walls" "$back" "<= $limit" "$(verdict "$worse" "<=" "$limit")" "$(digits "$iou" 3)" \
    "$(verdict "$iou" ">=" 0.85)" "$found of $seen" "$(verdict "$share" ">=" 80)" "$(get doors_false)"
}
for world in "corridor-loop 1 standard" "corridor-loop 7 hard" "warehouse 1 standard" "warehouse 5 standard"; do
  set -- $world
  plan=plan-$1-$2
  render "$plan" "$1" --seed "$2" --difficulty "$3" --stereo
  for sensor in rgbd stereo mono; do
    case $sensor in mono) height="--camera-height 1.4" ;; *) height= ;; esac
    run "$plan-$sensor" "$out/$plan-world" --sensor "$sensor" --config floor_plan $height
    plan_row "$plan-$sensor" "$1, seed $2, $3" "$sensor"
  done
done
mkdir -p docs/images
cp "$out/plan-corridor-loop-1-rgbd/floor_plan.png" docs/images/floor_plan_corridor.png
cp "$out/plan-warehouse-1-rgbd/floor_plan.png" docs/images/floor_plan_warehouse.png
picture "Floor plan of the rendered corridor" floor_plan_corridor.png
picture "Floor plan of the rendered warehouse" floor_plan_warehouse.png
