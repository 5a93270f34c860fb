#!/bin/sh
# no_codecs_mapped.sh FILE|FOLDER...: no program maps OpenCV's imgcodecs, videoio or ximgproc, librsvg or cairo,
# nor what they bring along, when it starts. Of a folder all programs below it are looked at.
set -eu
status=0
count=0
programs=$(for path in "$@"; do
  [ -d "$path" ] || echo "$path"
  [ ! -d "$path" ] || find "$path" -type f -perm -u+x ! -name '*.so*' ! -path '*/CMakeFiles/*'
done | LC_ALL=C sort)
while IFS= read -r program; do
  libraries=$(ldd "$program" 2> /dev/null) || continue  # a script
  count=$((count + 1))
  if found=$(printf '%s\n' "$libraries" |
    grep -E 'lib(opencv_(imgcodecs|videoio|ximgproc|highgui)|rsvg|cairo|gdal|gstreamer[^ ]*|avcodec)[.-]'); then
    printf '%s maps\n%s\n' "$program" "$found"
    status=1
  fi
done << END
$programs
END
[ $count -gt 0 ] || { echo "no_codecs_mapped: no program in $*"; exit 2; }
exit $status
