# Hard graphs made for practice, from every start.
title="Hard graphs, from every start"
export OPENBLAS_NUM_THREADS=1

# hard NAME SYNTH_GRAPH_ARGUMENTS...
hard() {
  graph=$out/hard-$1.g2o; label=$1; shift
  command_line "placegraph synth graph $(echo "$*" | sed "s|$data|\$DATA|") -o $label.g2o"
  $placegraph synth graph "$@" -o "$graph" --force > "$out/hard-$label.log"
}
# report LABEL: all starts of one graph
report() {
  label=$1
  say "hard graphs: $label"
  optimize "hard-$label-auto" "$out/hard-$label.g2o" --certify
  auto=$(number "$out/hard-$label-auto.json" chi2_log); lowest=$auto
  for start in auto file odometry chordal certified; do
    f=hard-$label-$start
    [ $start = auto ] || optimize "$f" "$out/hard-$label.g2o" --initialization $start
    chi2=$(number "$out/$f.json" chi2_log)
    [ -z "$chi2" ] || lowest=$(printf '%s\n' $lowest "$chi2" | LC_ALL=C sort -g | head -n 1)
    set -- "$@" "$(significant "$chi2" 9) ($(significant "$(number "$out/$f.json" cpu_ms)" 3) ms)"
  done
  cells "$@" "$(number "$out/hard-$label-auto.json" start | tr -d '"')" \
    "$(significant "$(number "$out/hard-$label-auto.json" certificate_gap)" 2)" \
    "$(verdict "${auto:-none}" "<=" "$(computed %.17g "${lowest:-0} * (1 + 1e-6)")")"
}

heading "$title"
made="walk20000 loop20 loop20-space"
hard walk20000 manhattan-walk --poses 20000
hard loop20 long-loop --closures 20
hard loop20-space long-loop --closures 20 --3d
if [ -f "$data/posegraphs/M3500.g2o" ]; then
  for noise in 0.1 0.2 0.3; do hard "M3500-$noise" "$data/posegraphs/M3500.g2o" --rotation-noise $noise; done
  made="M3500-0.1 M3500-0.2 M3500-0.3 $made"
fi
command_line "placegraph optimize GRAPH.g2o -o OUT.g2o --initialization START --json [--certify]"
columns graph "chi2_log (CPU) from auto" file odometry chordal certified "kept by auto" "gap of the certificate" "auto is the lowest, within 1e-6"
for label in $made; do report "$label"; done
