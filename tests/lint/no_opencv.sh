#!/bin/sh
# no_opencv.sh LINKED NM LIBRARY...: neither the list of what the targets link (LINKED, a file) nor an
# undefined symbol of the libraries leads to OpenCV.
set -eu
linked=$1
nm=$2
shift 2
[ -s "$linked" ] || { echo "$linked: empty"; exit 2; }
status=0
if grep -i opencv "$linked"; then
  echo "the targets above are linked"
  status=1
fi
for library in "$@"; do
  symbols=$("$nm" -C "$library")
  [ -n "$symbols" ] || { echo "$library: no symbols"; exit 2; }
  if printf '%s\n' "$symbols" | grep -E ' U (.*[^A-Za-z0-9_])?cv::'; then
    echo "$library needs the symbols above"
    status=1
  fi
done
exit $status
