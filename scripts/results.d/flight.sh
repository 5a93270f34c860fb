# Rendered flights: position, velocity, drift without markers, CPU a frame, consistency. FLIGHTS other than 50.
flights=${FLIGHTS:-50}
build_bench bench_flight_study
# fly NAME WORLD ARGUMENTS...: result.json in $out/NAME
fly() {
  name=$1; world=$2; shift 2
  say "flying $name"
  $placegraph flight run "$out/$world-world" --out "$out/$name" --force "$@" > "$out/$name.log" 2>&1 || { cat "$out/$name.log" >&2; return 1; }
}
heading "Flights: the pose by optical flow, IMU and markers"
command_line "placegraph synth sequence flight --out WORLD --seed SEED --difficulty DIFFICULTY"
command_line "placegraph flight run WORLD --out OUT"
command_line "placegraph flight run WORLD --out SMOOTH --smooth"
command_line "placegraph flight run WORLD --out ALONE --markers-until 3"
command_line "build/release/tests/bench/bench_flight_study $flights"
prose << 'NOTE'
Flights of 120 s in gusts (docs/synthetic_world.md), again and again without any marker in the image for more than 5 s.
`position` and `velocity` are the RMSE over all images, without alignment. `drift` is the error at the end of a flight that searched for markers
in its first 3 s only, over the path flown since. The smoother (`--smooth`) has the same measurements in a window of
twenty images; `filter / smoother` divides their position RMSE over the same images. CPU is the time of a frame, with the
reading of its image in brackets. `met` is for position <= 0.05, velocity <= 0.05, drift <= 2, ratio <= 1.5, CPU <= 6.
NOTE
columns flight "outages over 5 s" "position [m]" "velocity [m/s]" "drift [% of m]" "filter / smoother" "CPU [ms]" met
for flight in 1-standard 2-standard 3-standard 4-hard; do
  seed=${flight%-*}; difficulty=${flight#*-}
  render "flight$flight" flight --seed "$seed" --difficulty "$difficulty"
  fly "flight$flight" "flight$flight"
  fly "flight$flight-alone" "flight$flight" --markers-until 3
  f=$out/flight$flight/result.json; a=$out/flight$flight-alone/result.json
  fly "flight$flight-smooth" "flight$flight" --smooth
  ratio=$(number "$out/flight$flight-smooth/result.json" filter_over_smoother)
  position=$(number "$f" position_rmse_m); velocity=$(number "$f" velocity_rmse_mps)
  drift=$(number "$a" percent); cpu=$(number "$f" cpu_ms_per_frame)
  path=$(sed -n '/"drift"/,/}/p' "$a" | sed -nE 's/^ *"path_length_m": ([^,]*),?$/\1/p')
  cells "seed $seed, $difficulty" "$(number "$f" outages_over_5s) ($(digits "$(number "$f" longest_outage_s)" 1) s)" "$(digits "$position" 4)" "$(digits "$velocity" 4)" \
    "$(digits "$drift" 3) of $(digits "$path" 1)" "$(digits "$ratio" 2)" "$(digits "$cpu" 2) (+ $(digits "$(number "$f" reading_ms_per_frame)" 2))" \
    "$(verdict "$position" "<=" 0.05), $(verdict "$velocity" "<=" 0.05), $(verdict "$drift" "<=" 2), $(verdict "$ratio" "<=" 1.5), $(verdict "$cpu" "<=" 6)"
done
# The load of other work on the machine counts: caches are shared.
prose "Load of the machine when the flights were flown, over 15 minutes: $(cut -d ' ' -f 3 /proc/loadavg)."
prose << 'NOTE'
Markers that the flight maps (`--map-markers`): the layout gives the pose of its first marker alone, of the other five their sides. Errors are those
of the mapped markers in the world of the first. NEES per degree of freedom is 1 where they are as large as their
covariances state. The last two columns are the position RMSE of the flight by the first marker alone, and by the map that
came of it.
NOTE
command_line "placegraph flight run WORLD --out MAPPED --markers FIRST.yaml --map-markers --truth-markers WORLD/markers.yaml"
command_line "placegraph flight run WORLD --out AGAIN --markers MAPPED/markers.yaml"
columns flight "markers mapped" "worst error [mm]" "worst error [deg]" NEES "RMSE by one marker [m]" "RMSE by the map [m]"
for flight in 1-standard 2-standard 3-standard 4-hard; do
  world=$out/flight$flight-world
  # The first keeps its place, the others lose theirs; no beacons.
  awk '/side_m/ && n++ { sub(/, position.*/, "}") } /^beacons/ { print "beacons: []"; exit } { print }' "$world/markers.yaml" > "$out/first.yaml"
  fly "flight$flight-mapped" "flight$flight" --markers "$out/first.yaml" --map-markers --truth-markers "$world/markers.yaml"
  fly "flight$flight-again" "flight$flight" --markers "$out/flight$flight-mapped/markers.yaml"
  f=$out/flight$flight-mapped/result.json
  cells "seed ${flight%-*}, ${flight#*-}" "$(number "$f" compared_markers) of 5" "$(computed %.2f "1000 * $(number "$f" worst_error_m)")" "$(digits "$(number "$f" worst_error_deg)" 3)" \
    "$(digits "$(number "$f" nees_per_dof)" 2)" "$(digits "$(number "$f" position_rmse_m)" 4)" "$(digits "$(number "$out/flight$flight-again/result.json" position_rmse_m)" 4)"
done
say "flight: $flights flights without images"
build/release/tests/bench/bench_flight_study "$flights" > "$out/flight_study.tsv"
heading "Flights without images"
prose << NOTE
Mean over $flights flights of 120 s through the same pipeline without images: points of the floor, corners and beacons
are measured at their true positions with the noise of rendered flights, so that many seeds are affordable.
NOTE
columns figure target mean "least to most of a flight" met
# study KEY WHAT TARGET VERDICT
study() {
  mean=$(LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $2 }' "$out/flight_study.tsv")
  range=$(LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $3 " to " $4 }' "$out/flight_study.tsv")
  met=-
  case "$3" in
    "0.5 to 2") met="**no**"; [ "$(verdict "$mean" ">=" 0.5)" = yes ] && met=$(verdict "$mean" "<=" 2) ;;
    "<= "*) met=$(verdict "$mean" "<=" "${3#<= }") ;;
  esac
  cells "$2" "$3" "$mean" "$range" "$met"
}
study anees "ANEES of the whole state" "0.5 to 2"
study anees_position "ANEES of the position" "0.5 to 2"
study anees_velocity "ANEES of the velocity" "0.5 to 2"
study anees_attitude "ANEES of the attitude" "0.5 to 2"
study position_rmse_m "position RMSE [m]" "<= 0.05"
study velocity_rmse_mps "velocity RMSE [m/s]" "<= 0.05"
study drift_percent "drift after the last marker [% of the path]" "<= 2"
