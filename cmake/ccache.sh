#!/bin/sh
# ccache.sh COMPILER ARGUMENT...: compiles through ccache so that all clones on a machine share what they
# have compiled. Paths below the clone count as relative to it (base directory), and its own path does not
# count (no hash of the working directory). Precompiled headers need the sloppiness about defines and times.
#
# GCC's precompiled header (.gch) is the same in every clone. An old one is removed before it is made anew,
# because the compiler would read it first and its key would differ from that of a fresh build.
# It is looked up by the text of its headers alone (depend mode). Preprocessed text leaves comments out, and
# "#pragma once" knows a header again by its checksum: with a header made before a comment changed, the
# compiler would read that header a second time.
# Clang's (.pch) holds paths and times of its clone: each clone makes its own, and what is compiled with it
# is keyed by the checksum beside it (.pch.sum), of the arguments and of the headers that went into it.
#
# What a compilation costs is noted (compile_cost.sh, by its name, because a prefix with blanks would be two words): what
# comes from the cache has cost something, too.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
output=
dependencies=
previous=
count=$#
while [ "$count" -gt 0 ]; do
  argument=$1
  case $previous in
    -o) output=$argument ;;
    -MF) dependencies=$argument ;;
    -Xclang) argument=${argument#"$PWD"/} ;;  # ccache takes those as they stand
  esac
  previous=$1
  shift
  set -- "$@" "$argument"
  count=$((count - 1))
done

case $output in
  *.gch)
    rm -f "$output"
    export CCACHE_DEPEND=true ;;
  *.pch)
    rm -f "$output.sum"
    "$root/cmake/compile_cost.sh" "$@"
    # A file of make's dependencies: "target: header header \", blanks within a name behind a backslash.
    headers=$output.headers
    sed 's/^[^:]*: //; s/ *\\$//; s/\([^\\]\) /\1\n/g' "$dependencies" | sed 's/^ *//; s/\\ / /g; /^$/d' > "$headers"
    [ -s "$headers" ] || { echo "ccache.sh: $dependencies names no headers" >&2; exit 1; }
    { echo "$*" | sed "s|$root||g"; tr '\n' '\0' < "$headers" | xargs -0 cat || echo "unreadable in $root"; } |
      sha256sum > "$output.sum"
    rm "$headers"
    exit ;;
esac
PATH=$root/cmake:$PATH CCACHE_PREFIX="compile_cost.sh${CCACHE_PREFIX:+ $CCACHE_PREFIX}" CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=true CCACHE_PCH_EXTSUM=true \
  CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime exec ccache "$@"
