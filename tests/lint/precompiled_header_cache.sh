#!/bin/sh
# precompiled_header_cache.sh LAUNCHER COMPILER: a precompiled header that comes from the compiler cache is
# that of the present headers, down to their comments: "#pragma once" compares their text.
set -eu
launcher=$1
compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/cmake"
cp "$launcher" "$(dirname "$launcher")/compile_cost.sh" "$work/cmake/"
export PLACEGRAPH_COSTS="$work/costs"
cd "$work"
export CCACHE_DIR="$work/cache"

# build COMMENT CALL: makes the header and compiles a source that includes it.
build() {
  printf '#pragma once\n// %s\nstruct Point { int x; };\n' "$1" > point.h
  printf '#include "point.h"\nint %s(Point p) { return p.x; }\n' "$2" > source.cpp
  sh cmake/"$(basename "$launcher")" "$compiler" -x c++-header -MD -MF all.d -o all.h.gch -c all.h
  sh cmake/"$(basename "$launcher")" "$compiler" -include all.h -MD -MF source.d -o source.o -c source.cpp ||
    { echo "a source does not compile with the header made after '$1'"; exit 1; }
}
printf '#include "point.h"\n' > all.h
build 'A point of the plane.' first
build 'A point on a plane.' second
