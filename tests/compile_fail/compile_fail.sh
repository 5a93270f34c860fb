#!/bin/sh
# compile_fail.sh FOLDER COMPILER FLAGS...: compiles.cpp must compile, every other source of the folder must not,
# and what the compiler says of it must name the source itself.
folder=$1
shift
if ! message=$("$@" "$folder/compiles.cpp" 2>&1); then
  echo "compiles.cpp must compile:"
  echo "$message"
  exit 1
fi
failed=0
for source in "$folder"/*.cpp; do
  name=$(basename "$source")
  [ "$name" = compiles.cpp ] && continue
  if message=$("$@" "$source" 2>&1); then
    echo "$name compiles: $(sed -n 's,^// ,,p;q' "$source")"
    failed=1
  elif ! echo "$message" | grep -q "$name:[0-9]*:[0-9]*: error"; then
    echo "$name fails for another reason than its mistake:"
    echo "$message"
    failed=1
  fi
done
exit $failed
