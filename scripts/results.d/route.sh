# Shortest routes over the places of rendered drives against the truth, and the route back replayed.
build_bench bench_route_study
heading "Routes over the place graph of rendered drives"
command_line "placegraph synth sequence town-loop --out TOWN --difficulty standard"
command_line "placegraph synth sequence \$DATA/kitti_gt/06/poses.txt --out R06 --difficulty standard --mono    # KITTI 00 likewise"
command_line "build/release/tests/bench/bench_route_study WORLD [FRAMES [CAMERA_HEIGHT]]"
prose << 'NOTE'
A map is made of a drive, or of its first frames: in stereo in the town, by one camera of known height elsewhere.
NOTE
prose << 'NOTE'
Routes: the shortest routes between 500 pairs of places, spread over the map, against the shortest ones over the same
roads with every place at its true position. The table has how many go over the very same places, and how much longer
in truth the others are at worst (excess). The detour is against the shortest route along the driven path, in which
passes within 5 m and 30 deg of each other are one road; the map joins passes where it recognized them, some metres
after they met. Detours and length errors are medians.
NOTE
prose << 'NOTE'
Recognition: at every step of the route back between places spread over the map the robot gets a frame that the map does
not keep. It is one of another pass within 5 m where there is one (of a later pass than the map has, where the map is
made of the first frames), else a neighbour of the kept frame. It is searched among all views of the map without a prior
position, and is right if it is recognized within 5 m and 30 deg of its true pose. `steps back` and `routes back`: the
steps that were recognized, and the routes of which all were.
NOTE
columns drive places "same places" "worst excess [%]" "detour [%] (worst [m])" "length error [%] (worst)"
rest=$out/route-rest.md  # the second half of each row
: > "$rest"
# route_back NAME WHAT POSES FRAMES HEIGHT
route_back() {
  say "route: $2"
  build/release/tests/bench/bench_route_study "$out/$1-world" "$3" "$4" > "$out/route.tsv" 2> "$out/route.err" || { cat "$out/route.err" >&2; return 1; }
  value_of() { LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $2 }' "$out/route.tsv"; }
  met=no
  [ "$(value_of "pairs apart")" = 0 ] && [ "$(value_of "steps back recognized")" = "$(value_of "steps back")" ] && met=$(verdict "$(value_of "excess, worst [%]")" "<=" 0.1)
  [ "$met" = yes ] || met='**no**'
  cells "$2" "$(value_of places)" "$(value_of "pairs over the same places") of $(value_of pairs)" "$(digits "$(value_of "excess, worst [%]")")" \
    "$(digits "$(value_of "detour, median [%]")" 2) ($(digits "$(value_of "detour, worst [m]")" 1))" "$(digits "$(value_of "length error, median [%]")" 2) ($(digits "$(value_of "length error, worst [%]")" 2))"
  printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$2" "$(value_of "another pass, recognized") of $(value_of "another pass, places")" "$(value_of "neighbours, recognized") of $(value_of "neighbours, places")" \
    "$(digits "$(value_of "another pass, position error, median [m]")" 3)" \
    "$(value_of "steps back recognized") of $(value_of "steps back")" "$(value_of "ways back recognized at every step") of $(value_of "ways back")" "$met" >> "$rest"
}
render_town
route_back town "town-loop" 0 0
route_back town "town-loop, map of 560 of 764 frames" 560 0
if [ -f "$data/kitti_gt/06/poses.txt" ]; then
  render_kitti06
  render rendered00 "$data/kitti_gt/00/poses.txt" --difficulty standard --mono
  route_back rendered06 "KITTI 06" 0 1.65
  route_back rendered06 "KITTI 06, map of 830 of 1101 frames" 830 1.65
  route_back rendered00 "KITTI 00" 0 1.65
else
  say "route: rendered drives: absent"
fi
columns drive "by another pass" "by neighbours" "position error [m]" "steps back" "routes back" met
cat "$rest" >> "$rows"
