#!/bin/sh
# ccache.sh COMPILER ARGUMENT...: compiles through ccache so that all clones on a machine share what they
# have compiled. Paths below the clone count as relative to it (base directory), and its own path does not
# count (no hash of the working directory). Precompiled headers need the sloppiness about defines and times;
# an old one is removed before it is made anew, because the compiler would read it first and its key would
# differ from that of a fresh build.
root=$(dirname "$0")/..
previous=
for argument; do
  case "$previous $argument" in "-o "*.gch) rm -f "$argument" ;; esac
  previous=$argument
done
CCACHE_BASEDIR=$(cd "$root" && pwd) CCACHE_NOHASHDIR=true \
  CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime exec ccache "$@"
