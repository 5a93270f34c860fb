# Optical flow against the exact flow of rendered frames, and what is read from it. FLOW_FRAMES other than 6.
frames=${FLOW_FRAMES:-6}
build_bench bench_flow_study
say "flow: rendering and following"
build/release/tests/bench/bench_flow_study "$out/flow" "$frames" > "$out/flow.log"
# value_of WHAT: a figure of the targets
value_of() { sed -n "s/^$1	//p" "$out/flow_targets.tsv"; }
# ratio A B
ratio() { LC_ALL=C awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3f", a / b }'; }

heading "Optical flow"
command_line "build/release/tests/bench/bench_flow_study out/flow $frames"
columns figure target measured met
for world in town-loop corridor-loop flight; do
  value=$(value_of "lucas-kanade over OpenCV's, $world")
  cells "error of Lucas-Kanade over OpenCV's where both answer, $world" "<= 1.05" "$value" "$(verdict "$value" "<=" 1.05)"
done
value=$(value_of "patches, RMS \[px\], interpolation")
cells "interpolation on planar patches up to 4 px, RMS [px]" "<= 0.05" "$value" "$(verdict "$value" "<=" 0.05)"
for other in lucas-kanade opencv-lucas-kanade; do
  value=$(ratio "$(value_of "patches, us, interpolation")" "$(value_of "patches, us, $other")")
  cells "interpolation, time a patch over that of $other" "< 1" "$value" "$(verdict "$value" "<=" 1)"
done
value=$(ratio "$(value_of "smooth scenes, mean error \[px\], horn-schunck")" "$(value_of "smooth scenes, mean error \[px\], farneback")")
cells "error of Horn-Schunck over Farneback's on smooth scenes" "< 1" "$value" "$(verdict "$value" "<=" 1)"
value=$(value_of "time to contact, worst error \[%\]")
cells "time to contact from 10 s to 1 s, worst error [%]" "<= 5" "$value" "$(verdict "$value" "<=" 5)"
value=$(value_of "speed over height, worst error \[%\]")
cells "speed over height, worst error [%]" "<= 3" "$value" "$(verdict "$value" "<=" 3)"
prose << NOTE
Rendered frames against their exact flow ($frames frames a world, spread over it). Methods of points have a grid of four
pixels and no flow between; the flow of what the next frame hides counts as error. The second table has patches of a
plane that faces the camera.
NOTE
gap
cat "$out/flow.md" >> "$rows"
