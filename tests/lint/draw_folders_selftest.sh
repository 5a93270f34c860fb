#!/bin/sh
# draw_folders_selftest.sh ROOT: the check of docs/images/folders.svg notices a stale picture, and an
# include that points up is counted.
set -eu
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
draw() {
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$root/tests/lint" \
    python3 "$root/scripts/draw_folders.d/draw_folders.py" "$work" "$@"
}

mkdir -p "$work/graph/core" "$work/io/files" "$work/docs/images" "$work/tests/lint"
printf '[graph]\ngraph/core:\ngraph: graph/core\n[io: graph]\nio/files: graph\n' \
  > "$work/tests/lint/include_directions.txt"
echo 'int a;' > "$work/graph/core/a.h"
echo '#include <placegraph/graph/core/a.h>' > "$work/graph/b.h"
echo '#include <placegraph/graph/b.h>' > "$work/io/files/c.h"
! draw --check > /dev/null || { echo "a picture that is missing passes"; exit 1; }
draw > "$work/figures"
grep -q '^arrows: 2$' "$work/figures" || { cat "$work/figures"; exit 1; }
draw --check > /dev/null || { echo "the picture that was drawn is refused"; exit 1; }

echo '#include <placegraph/graph/b.h>' >> "$work/graph/core/a.h"
! draw --check > /dev/null || { echo "a stale picture passes"; exit 1; }
draw > "$work/figures"
for line in 'arrows upward: 1' 'circles between folders: 1' '  graph, graph/core'; do
  grep -q "^$line\$" "$work/figures" || { echo "missing: $line"; cat "$work/figures"; exit 1; }
done
