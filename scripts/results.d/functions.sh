# What the sections of scripts/results are written with. A section writes Markdown into $rows, which
# becomes docs/results/SECTION.md; its files lie in $out.

# digits VALUE [N]: rounded for the table
digits() { case "$1" in null|'') echo "none" ;; *) LC_ALL=C awk -v v="$1" -v n="${2:-3}" 'BEGIN { printf "%.*f", n, v }' ;; esac; }
# significant VALUE [N]: N digits of it
significant() { case "$1" in null|'') echo "none" ;; *) LC_ALL=C awk -v v="$1" -v n="${2:-10}" 'BEGIN { printf "%.*g", n, v }' ;; esac; }
# verdict VALUE OP LIMIT
verdict() {
  LC_ALL=C awk -v v="$1" -v op="$2" -v l="$3" 'BEGIN {
    ok = v ~ /^[-+0-9.eE]+$/ && (op == "<=" ? v + 0 <= l + 0 : op == ">=" ? v + 0 >= l + 0 : v + 0 == l + 0)
    print ok ? "yes" : "**no**" }'
}
# gap: an empty line, where the last is not empty
gap() { [ -z "$(tail -n 1 "$rows")" ] || echo >> "$rows"; }
# heading TEXT: the first of a section is that of its page
heading() { if [ -s "$rows" ]; then gap; printf '## %s\n\n' "$1" >> "$rows"; else printf '# %s\n\n' "$1" >> "$rows"; fi; }
# command_line TEXT: a line of a code block; a long one is continued, and its remark (# ...) stands above it
command_line() {
  case $(tail -n 1 "$rows") in '    '*) ;; *) gap ;; esac
  printf '%s\n' "$1" | LC_ALL=C awk '{
    if (length > 96 && match($0, /  +# /)) {
      print "    " substr($0, RSTART + RLENGTH - 2)
      $0 = substr($0, 1, RSTART - 1)
    }
    if (length <= 96) { print "    " $0; next }
    count = split($0, word, " "); line = "    " word[1]
    for (i = 2; i <= count; i++) {
      part = word[i]  # an option stays with its value
      if (part ~ /^-/ && i < count && word[i + 1] !~ /^[-[]/) part = part " " word[++i]
      if (length(line) + 1 + length(part) > 98) { print line " \\"; line = "        " part }
      else line = line " " part
    }
    print line
  }' >> "$rows"
}
# prose [TEXT]: a paragraph, of the text or of standard input, in lines of 100 characters at most
prose() {
  gap
  { if [ $# -gt 0 ]; then printf '%s' "$1"; else cat; fi; } | tr '\n' ' ' | sed 's/ *$//' | fold -s -w 100 | sed 's/ *$//' >> "$rows"
  echo >> "$rows"
}
# picture TITLE FILE: of docs/images
picture() { gap; printf '![%s](../images/%s)\n' "$1" "$2" >> "$rows"; }
# cells CELL...: a row of a table
cells() { printf '| %s ' "$@" >> "$rows"; echo "|" >> "$rows"; }
# columns NAME...: the head of a table
columns() {
  gap
  cells "$@"
  for column in "$@"; do printf '|---' >> "$rows"; done
  echo "|" >> "$rows"
}
# A table of figures of trajectories: row WHAT ALIGN LENGTHS STEP TARGET MEASURED MET
table() { columns figure align "lengths [m]" step target measured met; }
row() { cells "$@"; }
absent() { heading "$1"; echo "Absent: the data are not on this machine." >> "$rows"; say "$1: absent"; }

# build_reference: the program of the reference runs, by the compiler alone
build_reference() { "${CXX:-g++}" -O2 -o "$out/reference_run" scripts/results.d/reference_run.cpp; }
# reference_seconds: the CPU time of five reference runs, one a line
reference_seconds() { for k in 1 2 3 4 5; do "$out/reference_run"; done; }
# reference_line BEFORE AFTER: for the foot of a page
reference_line() {
  printf '%s s (%s before, %s after)' "$(digits "$(printf '%s\n' "$1" "$2" | median)")" \
    "$(digits "$(echo "$1" | median)")" "$(digits "$(echo "$2" | median)")"
}

# build_bench TARGET...: programs of tests/bench, which the preset leaves out
build_bench() {
  [ -z "${PLACEGRAPH:-}" ] || { say "$* would have to be built: run this section without PLACEGRAPH"; return 1; }
  cmake --preset release -DPLACEGRAPH_BENCH=ON > "$out/configure.log"
  cmake --build --preset release -j"$(nproc)" --target "$@"
  cmake --preset release -DPLACEGRAPH_BENCH=OFF > "$out/configure.log"
}

# render NAME ARGUMENTS...: renders $out/NAME-world quietly
render() {
  name=$1; shift
  if [ -n "${REUSE_WORLDS:-}" ] && { [ -f "$out/$name-world/poses.txt" ] || [ -f "$out/$name-world/markers.yaml" ]; }; then return 0; fi
  say "rendering $name"
  $placegraph synth sequence "$@" --out "$out/$name-world" --force > "$out/$name-world.log" 2>&1 || {
    cat "$out/$name-world.log" >&2; return 1; }
}
render_town() { render town town-loop --difficulty standard; }
render_kitti06() { render rendered06 "$data/kitti_gt/06/poses.txt" --difficulty standard --mono; }
# run NAME SEQUENCE ARGUMENTS...: runs quietly into $out/NAME
run() {
  name=$1; sequence=$2; shift 2
  if [ -n "${REUSE_RUNS:-}" ] && [ -f "$out/$name/result.json" ] &&
    ! grep -q '"interrupted": true' "$out/$name/result.json"; then return 0; fi
  say "running $name"
  $placegraph run "$sequence" --out "$out/$name" --force "$@" > "$out/$name.log" 2>&1 || {
    cat "$out/$name.log" >&2; return 1; }
}
# judge NAME GT ESTIMATE ARGUMENTS...: JSON in $out/NAME.json
judge() {
  name=$1; truth=$2; estimate=$3; shift 3
  $placegraph eval "$truth" "$estimate" "$@" --json > "$out/$name.json" 2> "$out/$name.err" || {
    cat "$out/$name.err" >&2; return 1; }
}
# cost NAME: wall time and memory of a run
cost() {
  f=$out/$1/result.json
  gap
  printf '%s frames in %s s (%s s CPU), %s MB at most.\n' "$(number "$f" frames)" \
    "$(digits "$(number "$f" wall_s)" 1)" "$(digits "$(number "$f" cpu_s)" 1)" "$(digits "$(number "$f" peak_mb)" 0)" >> "$rows"
}

# optimize NAME GRAPH ARGUMENTS...: $out/NAME.g2o and $out/NAME.json; neither where no minimum was found
optimize() {
  optimized=$out/$1; input=$2; shift 2
  status=0
  $placegraph optimize "$input" -o "$optimized.g2o" --force --json --quiet "$@" > "$optimized.json" 2> "$optimized.err" || status=$?
  [ "$status" = 0 ] || { rm -f "$optimized.json"; cat "$optimized.err" >&2; }
  [ "$status" -le 1 ]
}
# optimize_often N NAME GRAPH ARGUMENTS...: $out/NAME.1 to NAME.N
optimize_often() {
  times=$1; often=$2; shift 2
  for k in $(seq "$times"); do optimize "$often.$k" "$@"; done
}
# median_of NAME KEY: over the repeats that found a minimum
median_of() { for json in "$out/$1".[0-9]*.json; do number "$json" "$2"; done | median; }
# write_rounds COUNT FILE: poses of a drive COUNT times round a block, a pose a metre and each round
# 0.3 m beside the last: 95 m, half a circle of 20 m radius, 95 m, half a circle
write_rounds() {
  LC_ALL=C awk -v count="$1" 'BEGIN {
    pi = atan2(0, -1); r = 20; l = 95; arc = pi * r; round = 2 * (l + arc)
    for (k = 0; k < count; k++) for (s = 0; s < round; s++) {
      d = s; half_turn = 0; side = 0
      if (d >= l + arc) { d -= l + arc; half_turn = pi; side = 1 }
      if (d < l) { a = 0; x = 0; z = d } else { a = (d - l) / r; x = r * (1 - cos(a)); z = l + r * sin(a) }
      if (side) { x = 2 * r - x; z = l - z }
      a += half_turn; x += 0.3 * k * cos(a); z -= 0.3 * k * sin(a)
      printf "%.9g 0 %.9g %.9g 0 1 0 0 %.9g 0 %.9g %.9g\n", cos(a), sin(a), x, -sin(a), cos(a), z
    } }' > "$2"
}
