#!/bin/sh
# include_direction.sh ROOT: every rule of the project that can be read off the sources, one line for
# each violation as file:line; fails if there is one.
#   folders include what ROOT/tests/lint/include_directions.txt permits: include_directions.py
#   Ceres and CHOLMOD in no header outside backend; OpenGV in no header
#   OpenCV in headers only through graph/image, in the rest of graph and in backend not at all
#   GeographicLib only in graph/geometry/geodesy.cpp
#   libraries neither print nor end the process
#   in apps only the command line (cmd_*, main.cpp, help.*, command_line.*, shell/*) includes CLI11 and prints: include_directions.py
set -eu
lint=$(cd "$(dirname "$0")" && pwd)
cd "$1"

files=$(for folder in graph frontend backend io eval pipeline apps; do
  [ ! -d "$folder" ] || find "$folder/" -name '*.h' -o -name '*.cpp'
done | LC_ALL=C sort)
[ -n "$files" ] || { echo "$1: no sources"; exit 2; }

status=0
PYTHONDONTWRITEBYTECODE=1 python3 "$lint/include_directions.py" . || status=1

# shellcheck disable=SC2086
awk '
function complain(what) { printf "%s:%d: %s\n", file, FNR, what; violations++ }

FNR == 1 {
  file = FILENAME
  sub(/^\.\//, "", file)
  here = file
  sub(/\/.*/, "", here)
  header = file ~ /\.h$/
  images = file ~ /^graph\/image\//
  block = 0
}

{
  line = $0
  if (line !~ /^[ \t]*#[ \t]*include/) gsub(/"([^"\\]|\\.)*"/, "\"\"", line)
  sub(/\/\/.*/, "", line)
  while (1) {  # block comments
    if (block) {
      if (!sub(/^.*\*\//, "", line)) { line = ""; break }
      block = 0
    }
    gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", line)
    if (!sub(/\/\*.*/, "", line)) break
    block = 1
    break
  }
}

line ~ /^[ \t]*#[ \t]*include/ {
  path = line
  sub(/^[ \t]*#[ \t]*include[ \t]*[<"]/, "", path)
  sub(/[>"].*/, "", path)
  project = ""
  if (path ~ /^placegraph\//) project = substr(path, 12)
  else if (path ~ /^(graph|frontend|backend|io|eval|pipeline|apps|tests)\//) project = path
  if (path ~ /^opencv/) {
    if (header && !images && here != "apps")
      complain("OpenCV in a header: " path)
    else if (!images && (here == "graph" || here == "backend"))
      complain(here " may not use OpenCV: " path)
  }
  if (project ~ /^graph\/image\// && !images && (here == "backend" || here == "graph"))
    complain(here " must do without OpenCV: " path)
  if (tolower(path) ~ /geographiclib/ && file != "graph/geometry/geodesy.cpp")
    complain("GeographicLib outside graph/geometry/geodesy.cpp: " path)
}

header && here != "backend" && tolower(line) ~ /(^|[^a-z])(ceres|cholmod)/ {
  complain("a header outside backend names Ceres or CHOLMOD")
}
header && tolower(line) ~ /opengv/ { complain("a header names OpenGV") }

here != "apps" {
  if (line ~ /std::(cout|cerr|clog)([^A-Za-z0-9_]|$)/ || line ~ /(std|fmt)::print(ln)?[ \t]*\(/ ||
      line ~ /(^|[^A-Za-z0-9_])(v?printf|puts|putchar|perror)[ \t]*\(/ ||
      line ~ /(^|[^A-Za-z0-9_])(v?fprintf|fputs)[ \t]*\([^)]*std(out|err)/ ||
      line ~ /(^|[^A-Za-z0-9_])fputs[ \t]*\(.*,[ \t]*std(out|err)/)
    complain("a library prints")
  if (line ~ /(^|[^A-Za-z0-9_.>])(exit|_exit|_Exit|quick_exit|abort|terminate)[ \t]*\(/)
    complain("a library ends the process")
}

END { exit violations > 0 }
' $files || status=1
exit $status
