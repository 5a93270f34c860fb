#!/bin/sh
# include_direction_selftest.sh LINT: the lint passes a clean tree and catches every violation
# planted into a copy of it.
set -eu
lint=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

clean_tree() {
  rm -rf "$work/tree"
  mkdir -p "$work/tree"
  cd "$work/tree"
  mkdir -p graph/core frontend backend/factors io eval pipeline apps
  echo '#include <opencv2/core/mat.hpp>' > graph/core/image.h
  echo '#include <GeographicLib/LocalCartesian.hpp>' > graph/geometry/geodesy.cpp
  printf '#include <placegraph/graph/geometry/se3.h>\n/// As in Ceres. /* not cholmod */\n' > graph/map.h
  printf '#include <placegraph/graph/core/image.h>\nint at_exit(int);\n' > graph/measurements/frame.h
  printf '#include <placegraph/graph/map.h>\n#include <opengv/types.hpp>\n#include <opencv2/core.hpp>\n/* abort()\n   printf() */\n' > frontend/tracker.cpp
  printf '#include <ceres/ceres.h>\n#include <placegraph/backend/factors/a.h>\n' > backend/factors/b.h
  printf 'void f() { throw 1; }  // never exit()\nconst char* s = "printf(";\nint snprintf(char*);\n' > io/file.cpp
  printf '#include <placegraph/frontend/x.h>\n#include <placegraph/eval/x.h>\n' > pipeline/slam.cpp
  printf '#include <placegraph/pipeline/slam.h>\n#include <opencv2/core.hpp>\nint main() { std::cout << 1; exit(2); }\n' > apps/main.cpp
}

failures=0
# plant FILE LINE MESSAGE: LINE appended to FILE must be reported there with MESSAGE.
plant() {
  clean_tree
  printf '%s\n' "$2" >> "$1"
  number=$(wc -l < "$1")
  if output=$(sh "$lint" "$work/tree"); then
    echo "not caught: $1: $2"
    failures=$((failures + 1))
  elif [ "$output" != "$1:$number: $3" ]; then
    echo "caught otherwise: $1: $2: $output"
    failures=$((failures + 1))
  fi
}

clean_tree
sh "$lint" "$work/tree" || { echo "the clean tree is refused"; failures=1; }

plant graph/geometry/so3.h '#include <placegraph/graph/map.h>' \
  'core may not include placegraph/graph/map.h'
plant graph/map.h '#include <placegraph/io/graphs/g2o.h>' 'graph may not include placegraph/io/graphs/g2o.h'
plant graph/map.h '#include "backend/x.h"' 'graph may not include backend/x.h'
for from in frontend backend io eval; do
  for to in frontend backend io eval pipeline apps; do
    [ $from = $to ] || plant $from/a.h "#  include <placegraph/$to/x.h>" \
      "$from may not include placegraph/$to/x.h"
  done
done
plant pipeline/slam.cpp '#include <apps/support/output.h>' 'pipeline may not include apps/support/output.h'
plant io/file.cpp '#include "tests/support/data.h"' 'io may not include tests/support/data.h'
plant io/file.cpp '#include "../eval/x.h"' 'include by way of the parent folder: ../eval/x.h'
plant io/file.h '#include <ceres/loss.h>' 'a header outside backend names Ceres or CHOLMOD'
plant graph/map.h 'ceres::Solver* solver;' 'a header outside backend names Ceres or CHOLMOD'
plant eval/a.h 'struct cholmod_common;' 'a header outside backend names Ceres or CHOLMOD'
plant frontend/a.h 'opengv::points_t points;' 'a header names OpenGV'
plant backend/a.h 'opengv::points_t points;' 'a header names OpenGV'
plant io/file.h '#include <opencv2/core.hpp>' 'OpenCV in a header: opencv2/core.hpp'
plant graph/map.cpp '#include <opencv2/core.hpp>' 'graph may not use OpenCV: opencv2/core.hpp'
plant backend/a.cpp '#include <opencv2/core.hpp>' 'backend may not use OpenCV: opencv2/core.hpp'
plant graph/map.cpp '#include <placegraph/graph/measurements/frame.h>' \
  'graph must do without OpenCV: placegraph/graph/measurements/frame.h'
plant backend/a.h '#include <placegraph/graph/core/image.h>' \
  'backend must do without OpenCV: placegraph/graph/core/image.h'
plant graph/geometry/geodesy.h '#include <GeographicLib/Geodesic.hpp>' \
  'GeographicLib outside graph/geometry/geodesy.cpp: GeographicLib/Geodesic.hpp'
for line in 'std::cout << 1;' 'x(); std::cerr<<1;' 'std::printf("a");' '  printf("a");' \
  'puts("a");' 'fmt::print("a");' 'std::fprintf(stderr, "a");' 'fputs("a", stdout);'; do
  plant eval/a.cpp "$line" 'a library prints'
done
for line in 'std::exit(1);' '  exit(1);' 'if (x) abort();' 'std::terminate();' '::_exit(2);'; do
  plant pipeline/slam.cpp "$line" 'a library ends the process'
done

[ $failures = 0 ] || { echo "$failures failures"; exit 1; }
