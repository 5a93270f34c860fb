# Square markers: the simulated tags of the research data, and a sweep of rendered views. MARKER_SEEDS other than 3.
seeds=${MARKER_SEEDS:-3}
build_bench bench_marker_study
say "markers: rendering and looking"
tags=$data/scene/apriltag_sim
[ -d "$tags" ] || tags=
build/release/tests/bench/bench_marker_study "$out/markers" "$seeds" ${tags:+"$tags"} > "$out/markers.log"
# value_of WHAT: a figure of the targets
value_of() { sed -n "s/^$1	//p" "$out/markers_targets.tsv"; }

heading "Markers"
command_line "build/release/tests/bench/bench_marker_study out/markers $seeds \$DATA/scene/apriltag_sim"
columns figure target measured met
if [ -n "$tags" ]; then
  value=$(value_of "apriltag_sim, corners \[px\]")
  cells "apriltag_sim, corners, worst [px]" "<= 0.3" "$value" "$(verdict "$value" "<=" 0.3)"
  value=$(value_of "apriltag_sim, position \[%\]")
  cells "apriltag_sim, position, worst [% of range]" "<= 1" "$value" "$(verdict "$value" "<=" 1)"
  value=$(value_of "apriltag_sim, attitude \[deg\]")
  cells "apriltag_sim, attitude, worst [deg]" "<= 0.5" "$value" "$(verdict "$value" "<=" 0.5)"
fi
for views in sweep swaying; do
  value=$(value_of "$views, wrong poses")
  cells "$views: wrong planar pose chosen, of $(value_of "$views, views seen") views with the marker ($(value_of "$views, undecided") undecided)" 0 "$value" "$(verdict "$value" "<=" 0)"
done
value=$(value_of "sweep, corners, 95 % \[px\]")
cells "sweep: corners, 95 % below [px] (99 %: $(value_of "sweep, corners, 99 % \[px\]"))" "<= 0.3" "$value" "$(verdict "$value" "<=" 0.3)"
prose << NOTE
CPU: $(value_of "whole image \[ms CPU\]") ms for the whole of apriltag_sim (640x480, five tags),
$(value_of "five markers near where they were \[ms CPU\]") ms where they are searched near their last positions only.
The corners are compared as the README of apriltag_sim has them: the centres of pixels at halves, tags rotated by 180 deg.
NOTE
prose << 'NOTE'
The sweep: a marker of 0.2 m at 0.6 to 4 m, 460 px of focal length, tilts from 0 to 75 deg, blur of 0.5 to 1.5 px, noise
of 2 and 8 grey levels, single views without prior knowledge. Then a camera sways from above to the side and back, with
its rotation known by a gyro. A wrong pose is one nearer to the mirrored pose than to the true one; undecided views
report no pose. Pixels are errors of the corners; NEES/8 is that of the corners, NEES/6 that of the pose.
NOTE
gap
cat "$out/markers.md" >> "$rows"
