# Instructions of fixed workloads, counted by valgrind's callgrind: what a change costs on any
# machine. Valgrind shows every program the same processor (with AVX2, without AVX-512) wherever the real
# one has AVX2; threads, processors, environment and folder are pinned. What is read is made under
# valgrind too, so that rounding does not depend on the machine either. INSTRUCTION_REPEATS counts each
# workload so often and prints the spread; INSTRUCTION_ROWS, a regular expression, takes some of the rows.
scripts/install_packages valgrind > "$out/instructions-install.log" 2>&1 || { cat "$out/instructions-install.log" >&2; return 1; }
command -v valgrind > /dev/null || { say "instructions: valgrind is not installed"; return 1; }
title="Instructions: what work costs on any machine"
work=$out/instructions
rm -rf "$work"; mkdir -p "$work"
case $placegraph in /*) program=$placegraph ;; *) program=$root/$placegraph ;; esac
processor_set=$(sed -nE 's/^Cpus_allowed_list:[[:space:]]*([0-9]+).*/\1/p' /proc/self/status)
[ -z "${INSTRUCTION_ROWS:-}" ] || say "instructions: rows like '$INSTRUCTION_ROWS' alone"

# pinned TOOL ARGUMENTS...: the program under valgrind in $work
pinned() {
  tool=$1; shift
  (cd "$work" && exec taskset -c "${processor_set:-0}" env -i PATH=/usr/bin:/bin HOME=/ LC_ALL=C TZ=UTC OPENBLAS_NUM_THREADS=1 \
    OMP_NUM_THREADS=1 OPENBLAS_CORETYPE=Haswell OPENCV_OPENCL_RUNTIME=disabled valgrind $tool "$program" "$@" > run.log 2>&1) || {
    tail -n 20 "$work/run.log" >&2; return 1; }
}
# made ARGUMENTS...: something that is read later
made() { say "instructions: making ($*)"; pinned --tool=none "$@"; }
# counted ARGUMENTS...: $instructions of one run; a folder `run` or a file out.g2o of an earlier one is removed
counted() {
  rm -rf "$work/run" "$work/out.g2o" "$work/counts"
  pinned "--tool=callgrind --callgrind-out-file=counts --cache-sim=no --branch-sim=no" "$@"
  instructions=$(sed -n 's/^\(summary\|totals\): *//p' "$work/counts" | head -n 1)
  case $instructions in ''|*[!0-9]*) say "instructions: no count in $work/counts"; return 1 ;; esac
}
wanted() { [ -z "${INSTRUCTION_ROWS:-}" ] || echo "$1" | grep -qE -- "$INSTRUCTION_ROWS"; }
million() { LC_ALL=C awk -v n="$1" -v s="$2" 'BEGIN { printf "%.1f", (n - s) / 1e6 }'; }
start=0 repeats=${INSTRUCTION_REPEATS:-1} widest=0
# work_of NAME ARGUMENTS...: a row, net of what the program takes to start
work_of() {
  row_name=$1; shift
  wanted "$row_name" || return 0
  lines=
  for k in $(seq "$repeats"); do
    say "instructions: $row_name"
    counted "$@"
    lines="$lines$instructions
"
  done
  middle=$(printf '%s' "$lines" | median)
  apart=$(printf '%s' "$lines" | LC_ALL=C awk -v s="$start" 'NR == 1 { low = high = $1 } { if ($1 < low) low = $1; if ($1 > high) high = $1 }
    END { printf "%.2g", (high > s ? 100 * (high - low) / (high - s) : 0) }')
  widest=$(printf '%s\n' "$widest" "$apart" | LC_ALL=C sort -g | tail -n 1)
  [ "$repeats" = 1 ] || say "instructions: $row_name: $(million "$middle" "$start") million, spread $apart %"
  cells "$row_name" "$(million "$middle" "$start")"
}
# walk_of NAME POSES FALSE_LOOPS ARGUMENTS...: a row of `optimize` on a walk
walk_of() {
  row_name=$1 poses=$2 false_loops=$3; shift 3
  wanted "$row_name" || return 0
  made synth graph manhattan-walk --poses "$poses" --false-loops "$false_loops" -o walk.g2o --force
  work_of "$row_name" optimize walk.g2o -o out.g2o --quiet "$@"
}
# frames_of NAME ARGUMENTS...: a row of `run` on ten frames of a town
frames_of() {
  row_name=$1; shift
  wanted "$row_name" || return 0
  [ -d "$work/town" ] || made synth town-loop --frames 10 --stereo --depth --threads 1 --out town
  work_of "$row_name" run town --threads 1 --out run "$@"
}
# published NAME GRAPH ARGUMENTS...: likewise on a graph of the data; without it the row says so
published() {
  row_name=$1 graph=$2; shift 2
  wanted "$row_name" || return 0
  if [ ! -f "$data/posegraphs/$graph.g2o" ]; then cells "$row_name" absent; return 0; fi
  cp -f "$data/posegraphs/$graph.g2o" "$work/$graph.g2o"
  input=$graph.g2o
  if [ "$graph" = intel ]; then
    made synth-graph intel.g2o --false-loops 100 -o intel-100.g2o --force
    input=intel-100.g2o
  fi
  work_of "$row_name" optimize "$input" -o out.g2o --quiet "$@"
}

heading "$title"
command_line "placegraph synth graph manhattan-walk --poses 3500|1000 [--false-loops 100] -o WALK.g2o"
command_line "placegraph synth graph \$DATA/posegraphs/intel.g2o --false-loops 100 -o INTEL.g2o"
command_line "placegraph synth sequence town-loop --frames 10 --stereo --depth --threads 1 --out TOWN"
command_line "valgrind --tool=callgrind placegraph optimize GRAPH.g2o -o OUT.g2o --quiet [--incremental|--robust auto]"
command_line "valgrind --tool=callgrind placegraph eval TRUTH.txt ESTIMATE.txt --align se3 --json"
command_line "valgrind --tool=callgrind placegraph run TOWN --sensor SENSOR --threads 1 --out OUT    # mono: --camera-height 1.65"
columns work "instructions [million]"

say "instructions: start-up"
counted --version
start=$instructions
cells "start-up (--version)" "$(million "$start" 0)"

walk_of "batch: manhattan-walk of 3500 poses" 3500 0
walk_of "incremental: manhattan-walk of 1000 poses" 1000 0 --incremental
walk_of "robust: manhattan-walk of 1000 poses, 100 false loops" 1000 100 --robust auto
published "batch: M3500" M3500
published "batch: sphere2500" sphere2500
published "robust: intel, 100 false loops" intel --robust auto

# The estimate drifts by 0.5 % and sways by 0.1 m.
write_rounds 3 "$work/truth.txt"
LC_ALL=C awk '{ $4 = sprintf("%.9g", 1.005 * $4 + 0.1 * sin(NR / 50)); $12 = sprintf("%.9g", 1.005 * $12 + 0.1 * cos(NR / 50)); print }' \
  "$work/truth.txt" > "$work/estimate.txt"
work_of "eval: $(wc -l < "$work/truth.txt") poses" eval truth.txt estimate.txt --align se3 --json

frames_of "ten frames: monocular" --sensor mono --camera-height 1.65
frames_of "ten frames: stereo" --sensor stereo
frames_of "ten frames: RGB-D" --sensor rgbd
published "incremental: M3500" M3500 --incremental
prose << 'NOTE'
Counted by callgrind without simulated caches, one thread, OpenBLAS and OpenCV on the processor that valgrind shows (AVX2,
no AVX-512). Every row but the first is net of start-up. The counts hold for one set of compilers and libraries: compare
revisions built on one system. Counts of one program in three sittings, on an idle and on a busy machine, were at most
0.03 % apart, the start-up by 0.2 million.
NOTE
prose << 'NOTE'
Opening a sequence looks at one image in twenty for its grey levels, at most eight, and at one stereo pair in twenty for
its rows, at most four. Ten frames pay for one image (33 million here) and one pair (240 million), a thousand frames for
eight and four.
NOTE
[ "$repeats" = 1 ] || prose "Medians of $repeats counts, at most $widest % apart."
