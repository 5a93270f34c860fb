#!/bin/sh
# blas_binding.sh PROGRAM [ARGUMENTS]: whatever library asks for dgemm_, among them CHOLMOD, gets OpenBLAS.
# The packaged Ceres brings ATLAS along, and the first library in the order of loading wins.
set -eu
log=$(mktemp)
trap 'rm -f "$log"' EXIT
LD_BIND_NOW=1 LD_DEBUG=bindings "$@" > /dev/null 2> "$log" ||
  { echo "$1 failed"; tail -n 5 "$log"; exit 1; }
bindings=$(grep -E "binding file [^ ]*libcholmod[^ ]* .* symbol [\`']dgemm_'" "$log" || true)
[ -n "$bindings" ] || { echo "CHOLMOD's dgemm_ is bound nowhere: is CHOLMOD linked?"; exit 1; }
echo "$bindings"
if printf '%s\n' "$bindings" | grep -qv ' to [^ ]*libopenblas'; then
  echo "CHOLMOD's dgemm_ is not OpenBLAS'"
  exit 1
fi
