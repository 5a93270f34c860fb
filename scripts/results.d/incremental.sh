# Graphs that grow pose by pose.
title="Graphs that grow pose by pose"
[ -d "$data/posegraphs" ] || { absent "$title"; return 0; }
export OPENBLAS_NUM_THREADS=1
repeats=3

# grow GRAPH [MEAN_LIMIT] [COST_LIMIT]
grow() {
  say "growing $1"
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
columns graph "CPU of a step, mean [ms]" target met "95 % below [ms] (of the mean)" "<= 5 times" "longest [ms]" "chi2_log of the batch" "chi2_log in the end" target met
grow M3500 1.0 137.93
grow sphere2500 8
grow kitti_00 0.5
for graph in intel kitti_05 smallGrid3D parking-garage city10000 torus3D; do grow $graph; done
echo >> "$rows"
echo "Medians of $repeats runs where there is a limit, else one run." >> "$rows"
