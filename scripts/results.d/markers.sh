# Square markers: the simulated tags of the research data, and a sweep of rendered views. MARKER_SEEDS other than 3.
seeds=${MARKER_SEEDS:-3}
build_bench bench_marker_study
say "markers: rendering and looking"
tags=$data/scene/apriltag_sim
[ -d "$tags" ] || tags=
build/release/tests/bench/bench_marker_study "$out/markers" "$seeds" ${tags:+"$tags"} > "$out/markers.log"
# told WHAT: a figure of the targets
told() { sed -n "s/^$1	//p" "$out/markers_targets.tsv"; }

heading "Markers"
command_line "build/release/tests/bench/bench_marker_study out/markers $seeds \$DATA/scene/apriltag_sim"
columns figure target measured met
if [ -n "$tags" ]; then
  value=$(told "apriltag_sim, corners \[px\]")
  cells "apriltag_sim, corners, worst [px]" "<= 0.3" "$value" "$(verdict "$value" "<=" 0.3)"
  value=$(told "apriltag_sim, position \[%\]")
  cells "apriltag_sim, position, worst [% of range]" "<= 1" "$value" "$(verdict "$value" "<=" 1)"
  value=$(told "apriltag_sim, attitude \[deg\]")
  cells "apriltag_sim, attitude, worst [deg]" "<= 0.5" "$value" "$(verdict "$value" "<=" 0.5)"
fi
for views in sweep swaying; do
  value=$(told "$views, wrong poses")
  cells "$views: wrong planar pose chosen, of $(told "$views, views seen") views with the marker ($(told "$views, undecided") undecided)" 0 "$value" "$(verdict "$value" "<=" 0)"
done
value=$(told "sweep, corners, 95 % \[px\]")
cells "sweep: corners, 95 % below [px] (99 %: $(told "sweep, corners, 99 % \[px\]"))" "<= 0.3" "$value" "$(verdict "$value" "<=" 0.3)"
cat >> "$rows" <<EOF

CPU: $(told "whole image \[ms CPU\]") ms for the whole of apriltag_sim (640x480, five tags),
$(told "five markers near where they were \[ms CPU\]") ms looking only where they were.
Its corners are compared as its README has them, pixels' centres at halves, tags turned by half a turn.

The sweep: a marker of 0.2 m at 0.6 to 4 m, 460 px of focal length, tilts from 0 to 75 degrees, blur of 0.5 to 1.5 px, noise of 2 and 8 grey
levels, single views with nothing known before; then a camera that sways from above to the side and back, its turns known by a gyro. A
wrong pose is one nearer to the mirrored pose than to the true one; undecided views say nothing.

EOF
cat "$out/markers.md" >> "$rows"
