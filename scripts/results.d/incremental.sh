# Pose graphs that are optimized while they are extended.
title="Incremental pose graphs"
[ -d "$data/posegraphs" ] || { absent "$title"; return 0; }
export OPENBLAS_NUM_THREADS=1
repeats=3

# extended GRAPH [MEAN_LIMIT] [COST_LIMIT]
extended() {
  say "extending $1"
  optimize "incremental-$1-batch" "$data/posegraphs/$1.g2o"
  times=1; [ -z "${2:-}" ] || times=$repeats
  rm -f "$out/incremental-$1".[0-9]*.json
  optimize_often $times "incremental-$1" "$data/posegraphs/$1.g2o" --incremental
  batch=$(number "$out/incremental-$1-batch.json" chi2_log)
  chi2=$(median_of "incremental-$1" chi2_log); mean=$(median_of "incremental-$1" step_cpu_ms_mean)
  p95=$(median_of "incremental-$1" step_cpu_ms_p95); longest=$(median_of "incremental-$1" step_cpu_ms_max)
  if [ -z "$chi2" ]; then cells "$1" "no answer" - "**no**" - - - - - - -; return 0; fi
  limit=$(computed %.9g "$batch * (1 + 1e-4)")
  [ -z "${3:-}" ] || limit=$(printf '%s\n' "$limit" "$3" | LC_ALL=C sort -g | head -n 1)
  spread=$(computed %.2f "$p95 / $mean")
  cells "$1" "$(digits "$mean")" "${2:+<= $2}" "$([ -z "${2:-}" ] || verdict "$mean" "<=" "$2")" "$(digits "$p95") ($spread)" \
    "$(verdict "$spread" "<=" 5)" "$(digits "$longest" 1)" "$(significant "$batch")" "$(significant "$chi2")" "<= $limit" "$(verdict "$chi2" "<=" "$limit")"
}

heading "$title"
command_line "OPENBLAS_NUM_THREADS=1 placegraph optimize \$DATA/posegraphs/GRAPH.g2o -o OUT.g2o --incremental --json --quiet"
columns graph "mean [ms]" target met "95 % [ms]" "<= 5 times" "longest [ms]" "batch chi2_log" chi2_log target met
extended M3500 1.0 137.93
extended sphere2500 8
extended kitti_00 0.5
for graph in intel kitti_05 smallGrid3D parking-garage city10000 torus3D; do extended $graph; done
prose << NOTE
A step adds one pose and its edges. \`mean\` is its mean CPU time, \`95 %\` what 95 % of the steps stay below, with the
ratio to the mean in brackets. \`batch chi2_log\` is that of one optimization of the whole graph. Figures are medians of $repeats runs where there is a limit, else of one run.
NOTE
