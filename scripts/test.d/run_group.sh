# Sourced by scripts/test and scripts/sanitizers.
#
# run_group BUILD GROUP RESUME [CTEST_ARGUMENT...]: runs the ctests of BUILD that the arguments select, as
# many at a time as there are cores, and returns the exit code of ctest. BUILD/passed.GROUP notes which have
# passed. With RESUME (not empty) a group that was interrupted, or failed, goes on with the test programs
# that have not passed, as long as all programs are the same; what is no test program (lint, examples) looks
# at other files than programs and runs again.
run_group() {
  build=$1 group=$2 resume=$3
  shift 3
  results=$build/test_results passed=$build/passed.$group log=$build/tests.$group.log
  mkdir -p "$results"
  state=$(find "$build" -type f \( -name placegraph -o -name '*_tests' \) -perm -u+x | LC_ALL=C sort | xargs cat | cksum)
  if [ -n "$resume" ] && [ "$(head -n 1 "$passed" 2> /dev/null || true)" = "$state" ]; then
    note_passed
  else
    rm -f "$log"
    echo "$state" > "$passed"
    ctest --test-dir "$build" -N "$@" | sed -nE 's/^ *Test +#[0-9]+: ([^ ]+)$/\1/p' |
      while read -r name; do rm -f "$results/$name.xml"; done
  fi
  before=$(tail -n +2 "$passed" | LC_ALL=C sort -u | while read -r name; do
    [ ! -f "$results/$name.xml" ] || echo "$name"
  done | sed 's/[.]/[.]/g' | paste -sd '|' -)
  if [ -n "$before" ]; then set -- "$@" -E "^($before)\$"; else set -- "$@" --no-tests=error; fi
  # What a group costs is known if all of it runs.
  rm -f "$build/cost.$group"
  cost=$build/cost.$group
  [ -z "$before" ] || cost=/dev/null
  status=0
  scripts/test.d/cost.py run "$cost" \
    ctest --test-dir "$build" --output-on-failure -j"$(nproc)" "$@" --output-log "$log" || status=$?
  note_passed
  # Only an incomplete group goes on: the next call runs a complete one again.
  [ "$status" != 0 ] || sed -i '1s/$/ complete/' "$passed"
  return "$status"
}

# note_passed: by lines of the log like "12/99 Test #12: name ......   Passed    0.01 sec"
note_passed() {
  [ ! -f "$log" ] || sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* Passed .*/\1/p' "$log" >> "$passed"
}
