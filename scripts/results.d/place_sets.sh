# The sets of places, how they are matched and judged. To be sourced by places.sh.
sets="corridor_milford gardens_day_thumb"
[ ! -d "$data/sequences/sevenscenes_rgbd334" ] || sets="$sets kitchen"
# folder_of SET
folder_of() { case $1 in kitchen) echo "$data/sequences/sevenscenes_rgbd334" ;; *) echo "$data/places/$1" ;; esac; }
# found NAME SET ARGUMENTS...: matches and judges a set into $out/NAME.json
found() {
  name=$1; set_name=$2; shift 2
  folder=$(folder_of "$set_name")
  case "$set_name" in
    kitchen) age="--min-age 34"; truth="--true-poses $folder/poses.txt --radius 0.5 --heading 30 --min-age 34" ;;
    *) age=""; truth="--truth $folder/gt.txt" ;;
  esac
  say "matching $name"
  $placegraph match "$folder" $age --out "$out/$name.txt" --force "$@" > "$out/$name.log" 2>&1
  $placegraph loops --predictions "$out/$name.txt" $truth --json > "$out/$name.json"
}
# classified_right LABELS: the share of images of vtm_virtual_house with their label
classified_right() { awk 'NR == FNR { label[$1] = $2; next } { n++; right += $2 == label[$1] } END { print right / n }' "$data/places/vtm_virtual_house/labels.txt" "$1"; }
# figures NAME: R@1 / AP / recall at full precision
figures() {
  echo "$(digits "$(number "$out/$1.json" r_at_1)") / $(digits "$(number "$out/$1.json" ap)") / $(digits "$(number "$out/$1.json" recall_at_100p)")"
}
