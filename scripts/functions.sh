# What scripts/results, scripts/bench_posegraph and scripts/kill_study share. To be sourced.

say() { printf '%s: %s\n' "$0" "$1" >&2; }
# number FILE KEY: a scalar of a JSON file with one key a line; the first of that name, nothing without the file.
number() { [ ! -f "$1" ] || sed -nE "s/^ *\"$2\": ([^,]*),?\$/\1/p" "$1" | head -n 1; }
# median: of the numbers on standard input, one a line; nothing of none
median() {
  LC_ALL=C sort -g | LC_ALL=C awk '{ v[NR] = $1 } END { if (NR) printf "%.17g\n", NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}
# computed FORMAT EXPRESSION: by awk's arithmetic
computed() { LC_ALL=C awk "BEGIN { printf \"$1\", $2 }"; }
# processor: for the foot of a table
processor() { echo "$(nproc) cores ($(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2> /dev/null | head -n 1))"; }
