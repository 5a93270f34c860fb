# The optimum of every pose graph, in both conventions and by both engines, and its cost.
title="Pose graphs: optimum, time, engines, certificate"
[ -d "$data/posegraphs" ] || { absent "$title"; return 0; }
export OPENBLAS_NUM_THREADS=1
repeats=5

# What has to be reached: graph, chi2_g2o, chi2_log, CPU ms at most.
targets="intel 45.00469581 45.00423309 7
M3500 137.9129509 137.9148782 29
kitti_00 98.32201174 98.32213823 17
kitti_05 157.1043651 157.1038493 8
city10000 511.9851636 511.9874506 300
smallGrid3D 458.1537843 1035.850665 14
sphere2500 727.1496672 1351.401926 290
torus3D 14574.74644 24235.27376 700
parking-garage 1.23869058 1.268384799 58"

# report GRAPH COST TARGET CPU_LIMIT
report() {
  chi2=$(median_of "$1-$2" "chi2_$2"); ms=$(median_of "$1-$2" cpu_ms)
  ceres=$(number "$out/$1-$2-ceres.json" "chi2_$2")
  apart=none
  [ -z "$chi2" ] || [ -z "$ceres" ] || apart=$(computed %.1e "($ceres - $chi2) / $chi2")
  cells "$1" "$2" "$3" "$(significant "$chi2")" "$(verdict "${chi2:-none}" "<=" "$(computed %.17g "$3 * (1 + 1e-6)")")" "$4" \
    "$(digits "$ms" 1)" "$(verdict "${ms:-none}" "<=" "$4")" "$apart" "$(verdict "${apart#-}" "<=" 1e-6)" \
    "$(digits "$(number "$out/$1-$2-ceres.json" cpu_ms)" 0)" "$(significant "$(number "$out/$1-certified.json" certificate_gap)" 2)"
}

heading "$title"
command_line "OPENBLAS_NUM_THREADS=1 placegraph optimize \$DATA/posegraphs/GRAPH.g2o -o OUT.g2o --cost g2o|log --json --quiet [--engine ceres|--certify]"
columns graph cost "chi2 at most" chi2 met "at most [ms]" "CPU [ms]" met "Ceres above" "<= 1e-6" "Ceres [ms]" gap
for k in $(seq "$repeats"); do  # interleaved, so that a busy minute of the machine falls on all of them
  say "pose graphs, repeat $k of $repeats"
  echo "$targets" | while read -r graph g2o log limit; do
    for cost in g2o log; do optimize "$graph-$cost.$k" "$data/posegraphs/$graph.g2o" --cost $cost; done
  done
done
say "pose graphs: Ceres, certificates"
echo "$targets" | while read -r graph g2o log limit; do
  for cost in g2o log; do optimize "$graph-$cost-ceres" "$data/posegraphs/$graph.g2o" --cost $cost --engine ceres; done
  optimize "$graph-certified" "$data/posegraphs/$graph.g2o" --certify
  report "$graph" g2o "$g2o" "$limit"
  report "$graph" log "$log" "$limit"
done
prose << NOTE
\`chi2 at most\` is the best known minimum; a chi2 up to (1 + 1e-6) times that meets it. CPU times are medians of $repeats
runs of the solver. \`Ceres above\` is the relative difference of the minimum that the engine \`ceres\` finds,
and \`Ceres [ms]\` is its CPU time. The gap of the certificate is that of the isotropic chordal problem near the
solution in the log convention: it bounds, relatively, how far the minimum lies above the global one. It says
nothing about the cost of a graph whose information differs by direction.
NOTE
