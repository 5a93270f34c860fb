# The place graph against the graph of all keyframes.

share() { computed %.1f "100 * $1 / $2"; }
# whole_graph NAME SEQUENCE ARGUMENTS...: its place graph against the graph of all keyframes
whole_graph() {
  what=$1; places=$1-places; keyframes=$1-keyframes; sequence=$2; shift 2
  run "$places" "$sequence" "$@"
  run "$keyframes" "$sequence" --set places.max_distance=0 "$@"
  for graph_of in "$places" "$keyframes"; do
    judge "$graph_of-se3" "$sequence" "$out/$graph_of/trajectory_optimized.kitti" --align se3
    optimize "$graph_of-again" "$out/$graph_of/graph.g2o" --initialization file
  done
  ours=$(number "$out/$places-se3.json" ate_rmse_m); all=$(number "$out/$keyframes-se3.json" ate_rmse_m)
  nodes=$(number "$out/$places/result.json" places); all_nodes=$(number "$out/$places/result.json" keyframes)
  ms=$(number "$out/$places-again.json" cpu_ms); all_ms=$(number "$out/$keyframes-again.json" cpu_ms)
  row "$what: ATE RMSE, places / all keyframes [m]" se3 - - "<= 105 %" "$(digits "$ours" 4) / $(digits "$all" 4) ($(share "$ours" "$all") %)" \
    "$(verdict "$(share "$ours" "$all")" "<=" 105)"
  row "$what: nodes, places / keyframes" - - - - "$nodes / $all_nodes ($(share "$nodes" "$all_nodes") %)" -
  row "$what: CPU of one optimization, places / all keyframes [ms]" - - - - "$(digits "$ms" 2) / $(digits "$all_ms" 2) ($(share "$ms" "$all_ms") %)" -
}

heading "The place graph against the graph of all keyframes"
command_line "placegraph run SEQUENCE --out PLACES"
command_line "placegraph run SEQUENCE --out KEYFRAMES --set places.max_distance=0"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align se3"
command_line "placegraph optimize OUT/graph.g2o -o AGAIN.g2o --initialization file --json"
table
[ -d "$out/town-world" ] || render_town
whole_graph town "$out/town-world"
[ -d "$out/rendered06-world" ] || [ ! -d "$data/kitti_gt/06" ] || render_kitti06
[ ! -d "$out/rendered06-world" ] || whole_graph rendered06 "$out/rendered06-world" --sensor mono --camera-height 1.65
s=$data/sequences/sevenscenes_rgbd334
[ ! -d "$s" ] || whole_graph sevenscenes "$s" --sensor rgbd
