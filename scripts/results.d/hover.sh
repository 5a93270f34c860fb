# Flights of the hover world: position, velocity, drift without markers, CPU a frame, consistency. HOVER_FLIGHTS other than 50.
flights=${HOVER_FLIGHTS:-50}
build_bench bench_flight_study
# hover NAME WORLD ARGUMENTS...: result.json in $out/NAME
hover() {
  name=$1; world=$2; shift 2
  say "hovering $name"
  $placegraph flight run "$out/$world-world" --out "$out/$name" --force "$@" > "$out/$name.log" 2>&1 || { cat "$out/$name.log" >&2; return 1; }
}
heading "Hovering"
command_line "placegraph synth sequence flight --out WORLD --seed SEED --difficulty DIFFICULTY"
command_line "placegraph flight run WORLD --out OUT"
command_line "placegraph flight run WORLD --out SMOOTH --smooth"
command_line "placegraph flight run WORLD --out ALONE --markers-until 3"
command_line "build/release/tests/bench/bench_flight_study $flights"
printf '\nFlights of 120 s in gusts (docs/synthetic_world.md), out of sight of every marker for more than 5 s again and again. Errors are those of every\nimage, without alignment. The drift is the error at the end of a flight that looked for markers in its first 3 s only, over the way flown since. The smoother has the same measurements in a window\nof twenty images (`--smooth`); its position RMSE divides that of the filter over the same images.\n' >> "$rows"
columns flight "outages over 5 s (longest)" "position RMSE [m]" "velocity RMSE [m/s]" "drift [% of m]" "filter over smoother" "CPU a frame [ms] (+ reading)" "position <= 0.05, velocity <= 0.05, drift <= 2, ratio <= 1.5, CPU <= 6"
for flight in 1-standard 2-standard 3-standard 4-hard; do
  seed=${flight%-*}; difficulty=${flight#*-}
  render "hover$flight" hover --seed "$seed" --difficulty "$difficulty"
  hover "hover$flight" "hover$flight"
  hover "hover$flight-alone" "hover$flight" --markers-until 3
  f=$out/hover$flight/result.json; a=$out/hover$flight-alone/result.json
  hover "hover$flight-smooth" "hover$flight" --smooth
  ratio=$(number "$out/hover$flight-smooth/result.json" filter_over_smoother)
  position=$(number "$f" position_rmse_m); velocity=$(number "$f" velocity_rmse_mps)
  drift=$(number "$a" percent); cpu=$(number "$f" cpu_ms_per_frame)
  way=$(sed -n '/"drift"/,/}/p' "$a" | sed -nE 's/^ *"way_m": ([^,]*),?$/\1/p')
  cells "seed $seed, $difficulty" "$(number "$f" outages_over_5s) ($(digits "$(number "$f" longest_outage_s)" 1) s)" "$(digits "$position" 4)" "$(digits "$velocity" 4)" \
    "$(digits "$drift" 3) of $(digits "$way" 1)" "$(digits "$ratio" 2)" "$(digits "$cpu" 2) (+ $(digits "$(number "$f" reading_ms_per_frame)" 2))" \
    "$(verdict "$position" "<=" 0.05), $(verdict "$velocity" "<=" 0.05), $(verdict "$drift" "<=" 2), $(verdict "$ratio" "<=" 1.5), $(verdict "$cpu" "<=" 6)"
done
# The load of other work on the machine counts: caches are shared.
printf '\nLoad of the machine when the flights were flown, over 15 minutes: %s.\n' "$(cut -d ' ' -f 3 /proc/loadavg)" >> "$rows"
printf '\nMarkers mapped (`--map-markers`): the layout gives the place of its first marker alone, of the other five their sides. Errors are those of the markers that\nwere mapped, in the world of the first; NEES a degree of freedom is one where they are as large as their covariances say. The last two columns: position RMSE of the flight by the\nfirst marker alone, and by the map that came of it.\n\n' >> "$rows"
command_line "placegraph flight run WORLD --out MAPPED --markers FIRST.yaml --map-markers --truth-markers WORLD/markers.yaml"
command_line "placegraph flight run WORLD --out AGAIN --markers MAPPED/markers.yaml"
columns flight "markers mapped" "worst error [mm]" "worst error [deg]" "NEES a degree of freedom" "RMSE by one marker [m]" "RMSE by the map [m]"
for flight in 1-standard 2-standard 3-standard 4-hard; do
  world=$out/hover$flight-world
  # The first keeps its place, the others lose theirs; no beacons.
  awk '/side_m/ && n++ { sub(/, position.*/, "}") } /^beacons/ { print "beacons: []"; exit } { print }' "$world/markers.yaml" > "$out/first.yaml"
  hover "hover$flight-mapped" "hover$flight" --markers "$out/first.yaml" --map-markers --truth-markers "$world/markers.yaml"
  hover "hover$flight-again" "hover$flight" --markers "$out/hover$flight-mapped/markers.yaml"
  f=$out/hover$flight-mapped/result.json
  cells "seed ${flight%-*}, ${flight#*-}" "$(number "$f" compared_markers) of 5" "$(computed %.2f "1000 * $(number "$f" worst_error_m)")" "$(digits "$(number "$f" worst_error_deg)" 3)" \
    "$(digits "$(number "$f" nees_per_dof)" 2)" "$(digits "$(number "$f" position_rmse_m)" 4)" "$(digits "$(number "$out/hover$flight-again/result.json" position_rmse_m)" 4)"
done
say "hover: $flights flights without images"
build/release/tests/bench/bench_flight_study "$flights" > "$out/flight_study.tsv"
printf '\nMean over %s flights of 120 s through the same pipeline without images: points of the floor, corners and beacons measured where they truly are with the\nnoise of rendered flights, so that many seeds are affordable.\n' "$flights" >> "$rows"
columns figure target mean "least to most of a flight" met
# study KEY WHAT TARGET VERDICT
study() {
  mean=$(LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $2 }' "$out/flight_study.tsv")
  range=$(LC_ALL=C awk -F '\t' -v k="$1" '$1 == k { print $4 " to " $5 }' "$out/flight_study.tsv")
  met=-
  case "$3" in
    "0.5 to 2") met=no; [ "$(verdict "$mean" ">=" 0.5)" = yes ] && met=$(verdict "$mean" "<=" 2) ;;
    "<= "*) met=$(verdict "$mean" "<=" "${3#<= }") ;;
  esac
  cells "$2" "$3" "$mean" "$range" "$met"
}
study anees "ANEES per degree of freedom, whole state" "0.5 to 2"
study anees_position "of the position" "0.5 to 2"
study anees_velocity "of the velocity" "0.5 to 2"
study anees_attitude "of the attitude" "0.5 to 2"
study position_rmse_m "position RMSE [m]" "<= 0.05"
study velocity_rmse_mps "velocity RMSE [m/s]" "<= 0.05"
study drift_percent "drift after the last marker [% of the way]" "<= 2"
