# Hard graphs made for practice, from every initialization.
title="Hard graphs, from every initialization"
export OPENBLAS_NUM_THREADS=1

# hard NAME SYNTH_GRAPH_ARGUMENTS...
hard() {
  graph=$out/hard-$1.g2o; label=$1; shift
  command_line "placegraph synth graph $(echo "$*" | sed "s|$data|\$DATA|") -o $label.g2o"
  $placegraph synth graph "$@" -o "$graph" --force > "$out/hard-$label.log"
}
# report LABEL: all initializations of one graph; the second half of its row waits in $rest
report() {
  label=$1
  say "hard graphs: $label"
  optimize "hard-$label-auto" "$out/hard-$label.g2o" --certify
  auto=$(number "$out/hard-$label-auto.json" chi2_log); lowest=$auto
  for first in auto file odometry chordal certified; do
    f=hard-$label-$first
    [ $first = auto ] || optimize "$f" "$out/hard-$label.g2o" --initialization $first
    chi2=$(number "$out/$f.json" chi2_log)
    [ -z "$chi2" ] || lowest=$(printf '%s\n' $lowest "$chi2" | LC_ALL=C sort -g | head -n 1)
    set -- "$@" "$(significant "$chi2" 9) ($(significant "$(number "$out/$f.json" cpu_ms)" 3) ms)"
  done
  cells "$label" "$2" "$3" "$4"
  {
    printf '| %s ' "$label" "$5" "$6" "$(number "$out/hard-$label-auto.json" initialization | tr -d '"')" \
      "$(significant "$(number "$out/hard-$label-auto.json" certificate_gap)" 2)" \
      "$(verdict "${auto:-none}" "<=" "$(computed %.17g "${lowest:-0} * (1 + 1e-6)")")"
    echo "|"
  } >> "$rest"
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
command_line "placegraph optimize GRAPH.g2o -o OUT.g2o --initialization INITIALIZATION --json [--certify]"
rest=$out/hard-graphs-rest.md
: > "$rest"
prose 'A cell is the final chi2_log and the CPU time of the solver from that initialization.'
columns graph auto file odometry
for label in $made; do report "$label"; done
columns graph chordal certified "kept by auto" "gap of the certificate" "auto is the lowest, within 1e-6"
cat "$rest" >> "$rows"
