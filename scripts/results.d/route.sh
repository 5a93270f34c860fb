# Shortest ways over the places of rendered drives against the truth, and the way back replayed.
build_bench bench_route_study
heading "The way back over the places of rendered drives"
command_line "placegraph synth sequence town-loop --out TOWN --difficulty standard"
command_line "placegraph synth sequence \$DATA/kitti_gt/06/poses.txt --out R06 --difficulty standard --mono    # and 00"
command_line "build/release/tests/bench/bench_route_study WORLD [FRAMES [CAMERA_HEIGHT]]"
printf '\nA map is made of a drive, or of its first frames, by two eyes in town, by one of known height elsewhere. **Ways**: the shortest ones between 500 pairs of its places, spread over all, against the\nshortest over the same roads with every place where it truly is: how many go over the very same places, and how much longer by the truth the others are at worst. The detour is against the shortest\nway along what was driven, where passes within 5 m that look the same way (30 deg) are one road: the map joins passes where it recognized them, some metres after they met. **Recognition**: at every step of the way back between\nplaces spread over the map the robot sees a frame that the map does not keep, of another pass within 5 m where there is one (of a later one than the map has seen, where\nit is made of the first frames), else a neighbour of the kept frame; it is looked up among all views of the map, without being told where it is, and right if recognized within 5 m and 30 deg of\nwhere it truly is.\n' >> "$rows"
columns drive places "pairs over the same places" "worst excess [%]" "detour, median [%] (worst [m])" "length error, median (worst) [%]" "places recognized by another pass" "by neighbours" "position error there [m]" "steps back recognized" "ways back recognized whole" met
# way_back NAME WHAT POSES FRAMES HEIGHT
way_back() {
  say "route: $2"
  build/release/tests/bench/bench_route_study "$out/$1-world" "$3" "$4" > "$out/route.tsv" 2> "$out/route.err" || { cat "$out/route.err" >&2; return 1; }
  told() { LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $2 }' "$out/route.tsv"; }
  met=no
  [ "$(told "pairs apart")" = 0 ] && [ "$(told "steps back recognized")" = "$(told "steps back")" ] && met=$(verdict "$(told "excess, worst [%]")" "<=" 0.1)
  [ "$met" = yes ] || met='**no**'
  cells "$2" "$(told places)" "$(told "pairs over the same places") of $(told pairs)" "$(digits "$(told "excess, worst [%]")")" \
    "$(digits "$(told "detour, median [%]")" 2) ($(digits "$(told "detour, worst [m]")" 1))" "$(digits "$(told "length error, median [%]")" 2) ($(digits "$(told "length error, worst [%]")" 2))" \
    "$(told "another pass, recognized") of $(told "another pass, places")" "$(told "neighbours, recognized") of $(told "neighbours, places")" \
    "$(digits "$(told "another pass, position error, median [m]")" 3)" \
    "$(told "steps back recognized") of $(told "steps back")" "$(told "ways back recognized at every step") of $(told "ways back")" "$met"
}
render_town
way_back town "town-loop" 0 0
way_back town "town-loop, map of 560 of 764 frames" 560 0
if [ -f "$data/kitti_gt/06/poses.txt" ]; then
  render_kitti06
  render rendered00 "$data/kitti_gt/00/poses.txt" --difficulty standard --mono
  way_back rendered06 "KITTI 06" 0 1.65
  way_back rendered06 "KITTI 06, map of 830 of 1101 frames" 830 1.65
  way_back rendered00 "KITTI 00" 0 1.65
else
  say "route: rendered drives: absent"
fi
