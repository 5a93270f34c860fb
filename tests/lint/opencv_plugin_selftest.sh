#!/bin/sh
# opencv_plugin_selftest.sh LINT: the lint passes a clean tree and catches what is planted into it.
set -eu
lint=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/graph/image/plugin" "$work/io" "$work/tests" "$work/cmake" "$work/build"
echo '#include <opencv2/imgcodecs.hpp>' > "$work/graph/image/plugin/a.cpp"
echo 'target_link_libraries(a opencv_imgcodecs)' > "$work/graph/image/plugin/CMakeLists.txt"
echo 'find_package(OpenCV COMPONENTS imgcodecs)' > "$work/cmake/dependencies.cmake"
echo '#include <opencv2/videoio.hpp>' > "$work/build/a.cpp"
echo '#include <opencv2/imgproc.hpp>' > "$work/io/a.cpp"
sh "$lint" "$work" || { echo 'the clean tree is refused'; exit 1; }

failures=0
# plant FILE LINE: the line must be caught in this file.
plant() {
  printf 'int a;\n%s\n' "$2" > "$work/$1"
  if output=$(sh "$lint" "$work"); then
    echo "not caught: $2"
    failures=$((failures + 1))
  elif ! printf '%s\n' "$output" | grep -q "^$1:2:"; then
    echo "caught otherwise: $output"
    failures=$((failures + 1))
  fi
  rm "$work/$1"
}
plant io/b.cpp '#include <opencv2/imgcodecs.hpp>'
plant io/b.h '#  include <opencv2/videoio/registry.hpp>'
plant tests/b.cpp '#include "opencv2/ximgproc.hpp"'
plant tests/b.cpp '#include <opencv2/highgui.hpp>'
plant tests/b.cpp '#include <opencv2/opencv.hpp>'
plant io/CMakeLists.txt 'target_link_libraries(io PRIVATE opencv_core opencv_videoio)'
plant io/CMakeLists.txt '  opencv_ximgproc)'
plant cmake/b.cmake 'target_link_libraries(io PRIVATE ${OpenCV_LIBS})'
[ $failures = 0 ] || { echo "$failures failures"; exit 1; }
