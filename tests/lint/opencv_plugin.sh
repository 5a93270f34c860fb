#!/bin/sh
# opencv_plugin.sh ROOT: OpenCV's dnn, imgcodecs, videoio and ximgproc are included and linked by the module in
# ROOT/graph/image/plugin alone (cmake/dependencies.cmake looks for them), because they bring 200 libraries
# with them. Prints each violation as file:line.
set -eu
cd "$1"
files=$(find . \( -name build -o -name .git -o -path ./out -o -path ./tests/install -o -path ./graph/image/plugin \) -prune -o -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.in' -o -name CMakeLists.txt -o -name '*.cmake' \) -print |
  grep -v '^\./cmake/dependencies\.cmake$' | LC_ALL=C sort)
[ -n "$files" ] || { echo "$1: no sources"; exit 2; }
modules='(dnn|imgcodecs|videoio|ximgproc|highgui)'
# OpenCV_LIBS names all of them.
# shellcheck disable=SC2086
found=$(grep -nE "#[[:space:]]*include[[:space:]]*[<\"]opencv2/($modules|opencv\.hpp)|opencv_$modules([^A-Za-z0-9_]|\$)|OpenCV_LIBS" \
  /dev/null $files) || exit 0
printf '%s\n' "$found" | sed 's|^\./||'
echo 'what stands above belongs into graph/image/plugin'
exit 1
