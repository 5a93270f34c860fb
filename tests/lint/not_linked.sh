#!/bin/sh
# not_linked.sh TARGETS SYMBOLS LINKED NM LIBRARY...: neither the list of what the targets link (LINKED, a
# file) has a line that matches TARGETS (extended regular expression, any case), nor do the libraries need a
# symbol that begins with SYMBOLS.
set -eu
targets=$1
wanted=$2
linked=$3
nm=$4
shift 4
[ -s "$linked" ] || { echo "$linked: empty"; exit 2; }
status=0
if grep -iE "$targets" "$linked"; then
  echo "the targets above are linked"
  status=1
fi
for library in "$@"; do
  symbols=$("$nm" -C "$library")
  [ -n "$symbols" ] || { echo "$library: no symbols"; exit 2; }
  if printf '%s\n' "$symbols" | grep -E " U (.*[^A-Za-z0-9_])?($wanted)"; then
    echo "$library needs the symbols above"
    status=1
  fi
done
exit $status
