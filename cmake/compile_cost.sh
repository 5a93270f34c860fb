#!/bin/sh
# compile_cost.sh COMPILER ARGUMENT...: compiles, and notes the CPU seconds for scripts/test.d/cost.py: a file for each
# object in PLACEGRAPH_COSTS (~/.cache/placegraph_costs without it), below the name of the build folder. The file holds
# these seconds and those of the reference program at that time (PLACEGRAPH_REFERENCE_S; 0 if they are not known).
"$@"
status=$?
output=
previous=
for argument; do
  [ "$previous" != -o ] || output=$argument
  previous=$argument
done
costs=${PLACEGRAPH_COSTS:-${HOME:-/tmp}/.cache/placegraph_costs}/${PWD##*/}
if [ "$status" = 0 ] && [ -n "$output" ] && mkdir -p "$costs" 2> /dev/null; then
  note=$costs/$(echo "${output#"$PWD"/}" | tr / %)
  # The shell prints its own times and those of its children, a line each: minutes and seconds of user and system.
  times > "$note.$$" 2> /dev/null &&
    awk -v reference="${PLACEGRAPH_REFERENCE_S:-0}" 'NR == 2 {
        gsub(/s/, ""); split($1, user, "m"); split($2, kernel, "m")
        printf "%.2f %s\n", 60 * (user[1] + kernel[1]) + user[2] + kernel[2], reference
      }' "$note.$$" > "$note.$$.new" && mv "$note.$$.new" "$note"
  rm -f "$note.$$"
fi
exit $status
