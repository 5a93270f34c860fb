#!/bin/sh
# include_direction_selftest.sh LINT: the lint passes a clean tree and catches every violation
# planted into a copy of it.
set -eu
lint=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
table=tests/lint/include_directions.txt

clean_tree() {
  rm -rf "$work/tree"
  mkdir -p "$work/tree"
  cd "$work/tree"
  mkdir -p graph/core graph/geometry graph/image frontend/lines backend/factors backend/solver
  mkdir -p io/files eval pipeline apps tests/lint
  echo 'int a;' > graph/core/a.h
  echo '#include <opencv2/core/mat.hpp>' > graph/image/image.h
  printf '#include <GeographicLib/LocalCartesian.hpp>\n#include <placegraph/graph/core/a.h>\n' > graph/geometry/geodesy.cpp
  printf '#include <placegraph/graph/geometry/se3.h>\n/// As in Ceres. /* not cholmod */\n' > graph/map.h
  printf '#include <placegraph/graph/core/a.h>\n#include <placegraph/graph/image/image.h>\nint at_exit(int);\n' > graph/image/frame.h
  printf '#include <placegraph/graph/map.h>\n#include <opengv/types.hpp>\n#include <opencv2/core.hpp>\n/* abort()\n   printf() */\n' > frontend/tracker.cpp
  printf '/* a comment\n#include <placegraph/eval/x.h>\n*/ // "\n#include "frontend/tracker.h"\n' > frontend/lines/line.cpp
  printf '#include <ceres/ceres.h>\n#include <placegraph/backend/factors/a.h>\n' > backend/factors/b.h
  printf '#include <placegraph/backend/factors/a.h>\n' > backend/solver/a.h
  printf 'void f() { throw 1; }  // never exit()\nconst char* s = "printf(";\nint snprintf(char*);\n' > io/files/file.cpp
  printf 'int a;\n' > eval/a.cpp
  printf '#include <placegraph/frontend/x.h>\n#include <placegraph/eval/x.h>\n' > pipeline/slam.cpp
  printf '#include <placegraph/pipeline/slam.h>\n#include <opencv2/core.hpp>\nint main() { std::cout << 1; exit(2); }\n' > apps/main.cpp
  cat > $table << 'TABLE'
# The lines are counted below.
[graph]
graph/core:
graph/geometry: graph/core
graph: graph/geometry
graph/image: graph/core
[frontend: graph]
frontend: graph
frontend/lines: frontend
[backend: graph]
backend/factors:
backend/solver:
    backend/factors
[io: graph]
io/files:
[eval: graph]
eval:
[pipeline: graph frontend eval]
pipeline: frontend eval
[apps: graph frontend backend io eval pipeline]
apps: pipeline
TABLE
}

failures=0
# expect WHAT MESSAGE: the tree, in which WHAT was planted, is refused with MESSAGE alone.
expect() {
  if output=$(sh "$lint" "$work/tree"); then
    echo "not caught: $1"
    failures=$((failures + 1))
  elif [ "$output" != "$2" ]; then
    echo "caught otherwise: $1: $output"
    failures=$((failures + 1))
  fi
}
# plant FILE LINE MESSAGE: LINE appended to FILE must be reported there with MESSAGE.
plant() {
  clean_tree
  printf '%s\n' "$2" >> "$1"
  number=$(wc -l < "$1")
  expect "$1: $2" "$1:$number: $3"
}
# table EDIT MESSAGE: the table after the sed command EDIT must be refused with MESSAGE.
table() {
  clean_tree
  sed "$1" $table > edited
  mv edited $table
  expect "$1 in the table" "$2"
}

clean_tree
sh "$lint" "$work/tree" || { echo "the clean tree is refused"; failures=1; }

# Includes that the table does not permit.
plant graph/geometry/so3.h '#include <placegraph/graph/map.h>' \
  'graph/geometry may not include placegraph/graph/map.h'
plant graph/core/a.h '#include <placegraph/graph/geometry/so3.h>' \
  'graph/core may not include placegraph/graph/geometry/so3.h'
plant graph/map.h '#include <placegraph/io/graphs/g2o.h>' 'graph may not include placegraph/io/graphs/g2o.h'
plant backend/factors/b.h '#include <placegraph/backend/solver/a.h>' \
  'backend/factors may not include placegraph/backend/solver/a.h'
plant eval/a.h '#  include <placegraph/pipeline/x.h>' 'eval may not include placegraph/pipeline/x.h'
plant io/files/a.h '#include <placegraph/frontend/lines/x.h>' 'io/files may not include placegraph/frontend/lines/x.h'
plant pipeline/slam.cpp '#include <apps/support/output.h>' 'pipeline may not include apps/support/output.h'
plant apps/main.cpp '#include <placegraph/io/files/file.h>' 'apps may not include placegraph/io/files/file.h'
plant io/files/file.cpp '#include "tests/support/data.h"' 'io/files may not include tests/support/data.h'
plant io/files/file.cpp '#include "../eval/x.h"' 'include by way of the parent folder: ../eval/x.h'

# A divided idea.
clean_tree
mkdir graph/internal
echo 'int a;' > graph/internal/a.h
sed 's/^graph: .*/&\ngraph\/internal:/' $table > edited
mv edited $table
expect 'graph/internal' 'graph/internal/a.h:1: folder graph/internal: a header stands beside its source'

# Tables that do not fit the folders, or in which an arrow points up.
clean_tree
mkdir frontend/planes
echo '#include <placegraph/frontend/tracker.h>' > frontend/planes/plane.h
expect 'a folder without a line' \
  "frontend/planes/plane.h:1: folder frontend/planes is missing in $table"
clean_tree
for number in $(seq 10 38); do echo 'int a;' > eval/x$number.h; done
sh "$lint" "$work/tree" || { echo "thirty sources are refused"; failures=$((failures + 1)); }
echo 'int a;' > eval/x39.h
expect 'thirty-one sources' \
  "eval/x39.h:1: folder eval holds 31 sources, more than 30: it holds more than one idea"
table '8s/$/ graph\/core/' "$table:8: no include uses the permission frontend -> graph/core"
table '15s/$/\nio\/graphs:/' "$table:16: folder io/graphs holds no sources"
table '3s/$/ graph\/geometry/' "$table:3: graph/core: graph/geometry has no earlier line: the arrow points up
$table:3: no include uses the permission graph/core -> graph/geometry"
table '11s/$/ backend\/factors/' \
  "$table:11: backend/factors: backend/factors has no earlier line: the arrow points up"
table '11{h;d};13G' "$table:12: backend/solver: backend/factors has no earlier line: the arrow points up"
table '18s/ eval//' "$table:19: pipeline: layer pipeline may not include layer eval"
table '7s/graph/graph eval/' "$table:7: layer frontend: layer eval is not above this line"
table '15s/$/\nio\/files:/' "$table:16: io/files stands here a second time"
table '6s/$/ graph\/core/' "$table:6: graph/image: graph/core stands here a second time"
table '15s/$/\ngraph\/map:/' "$table:16: 'graph/map:': not a folder of the layer of this heading"
# A circle of two folders cannot be written down.
clean_tree
echo '#include <placegraph/backend/solver/a.h>' >> backend/factors/b.h
sed '11s/$/ backend\/solver/' $table > edited
mv edited $table
expect 'a circle' "$table:11: backend/factors: backend/solver has no earlier line: the arrow points up"

# Libraries that a layer does without.
plant io/files/file.h '#include <ceres/loss.h>' 'a header outside backend names Ceres or CHOLMOD'
plant graph/map.h 'ceres::Solver* solver;' 'a header outside backend names Ceres or CHOLMOD'
plant eval/a.h 'struct cholmod_common;' 'a header outside backend names Ceres or CHOLMOD'
plant frontend/a.h 'opengv::points_t points;' 'a header names OpenGV'
plant backend/solver/a.h 'opengv::points_t points;' 'a header names OpenGV'
plant io/files/file.h '#include <opencv2/core.hpp>' 'OpenCV in a header: opencv2/core.hpp'
plant graph/map.cpp '#include <opencv2/core.hpp>' 'graph may not use OpenCV: opencv2/core.hpp'
plant graph/geometry/so3.cpp '#include <opencv2/core.hpp>' 'graph may not use OpenCV: opencv2/core.hpp'
plant backend/solver/a.cpp '#include <opencv2/core.hpp>' 'backend may not use OpenCV: opencv2/core.hpp'
plant graph/geometry/geodesy.h '#include <GeographicLib/Geodesic.hpp>' \
  'GeographicLib outside graph/geometry/geodesy.cpp: GeographicLib/Geodesic.hpp'
clean_tree
echo '#include <placegraph/graph/image/image.h>' > backend/solver/a.h
sed 's/^backend\/solver:/& graph\/image/; 13d' $table > edited
mv edited $table
expect 'an image in the backend' \
  'backend/solver/a.h:1: backend must do without OpenCV: placegraph/graph/image/image.h'
clean_tree
echo '#include <placegraph/graph/image/frame.h>' >> graph/map.h
{ sed -n 1,4p $table; echo 'graph/image: graph/core'; echo 'graph: graph/geometry graph/image'; sed 1,6d $table; } > edited
mv edited $table
expect 'an image in the graph' \
  'graph/map.h:3: graph must do without OpenCV: placegraph/graph/image/frame.h'

# What only programs do.
# All lines at once: each is a fault of its own.
several() {
  clean_tree
  file=$1 message=$2 expected=
  shift 2
  for line in "$@"; do
    printf '%s\n' "$line" >> "$file"
    expected="$expected$file:$(($(wc -l < "$file"))): $message
"
  done
  expect "$file: all that $message" "${expected%
}"
}
several eval/a.cpp 'a library prints' 'std::cout << 1;' 'x(); std::cerr<<1;' 'std::printf("a");' '  printf("a");' \
  'puts("a");' 'fmt::print("a");' 'std::fprintf(stderr, "a");' 'fputs("a", stdout);'
several pipeline/slam.cpp 'a library ends the process' 'std::exit(1);' '  exit(1);' 'if (x) abort();' \
  'std::terminate();' '::_exit(2);'

# Commands are functions: the command line alone knows the option parser and prints.
plant apps/run.h '#include <CLI/App.hpp>' 'only cmd_* may include CLI/App.hpp'
plant apps/recmd_run.cpp '#include <CLI/CLI.hpp>' 'only cmd_* may include CLI/CLI.hpp'
several apps/run.cpp 'only cmd_* may print' 'std::cout << 1;' 'x(); std::cerr<<1;' 'std::printf("a");' \
  '  std::fprintf(stderr, "a");' 'std::puts("a");' 'fmt::print("a");' 'fputs("a", stdout);'
clean_tree
mkdir apps/support
sed 's/^apps: /apps\/support: graph\/core\n&apps\/support /' $table > edited
mv edited $table
echo '#include <placegraph/graph/core/a.h>' > apps/support/output.h
echo '#include <apps/support/output.h>' >> apps/main.cpp
for file in apps/cmd_run.cpp apps/help.h apps/support/cmd_option.h; do
  printf '#include <CLI/CLI.hpp>\nvoid f() { std::puts("a"); }\n' > $file
done
printf 'void f() { std::fwrite(0, 1, 1, stdout); }\n' > apps/support/output.cpp
printf 'int snprintf(char*);  // never printf()\nconst char* s = "std::puts(1);";\nvoid print();\n' > apps/run.cpp
sh "$lint" "$work/tree" || { echo "a command line that prints is refused"; failures=$((failures + 1)); }

[ $failures = 0 ] || { echo "$failures failures"; exit 1; }
