# A box that stands in the pictures of rendered towns, against where it truly would be seen.
# OVERLAY_FRAMES other than 40 a town.
frames=${OVERLAY_FRAMES:-40}
build_bench bench_overlay_study
heading "Contextual overlay"
command_line "build/release/tests/bench/bench_overlay_study configs/models/surfaces.pgscene OUT SEED $frames"
columns world frames boxes figure target measured met
for seed in 1 5; do
  say "overlay: town $seed"
  build/release/tests/bench/bench_overlay_study configs/models/surfaces.pgscene "$out/overlay-$seed" $seed "$frames" > "$out/overlay-$seed.log"
  # told FIGURE
  told() { sed -n "s/^$1	//p" "$out/overlay-${seed}_targets.tsv"; }
  # figure NAME TARGET OPERATOR BOUND WHICH
  figure() { cells "town-loop, seed $seed" "$frames" "$(told boxes)" "$1" "$2 $3" "$(told "$4")" "$(verdict "$(told "$4")" "$2" "$3")"; }
  figure "horizon, median error [deg]" "<=" 1 "horizon, median error \[deg\]"
  figure "foot of the box on a level plane, median error [px]" "<=" 3 "foot on a level plane, median error \[px\]"
  figure "on the road as it is, uneven, median error [px]" "<=" 3 "foot on the road, median error \[px\]"
  cells "town-loop, seed $seed" "$frames" "$(told boxes)" "the same by the true horizon" "" "$(told "foot on the road by the true horizon, median error \[px\]")" ""
  figure "pixels of the box rightly seen or hidden" ">=" 0.9 "pixels right"
  cells "town-loop, seed $seed" "$frames" "$(told boxes)" "on the pavement, higher than the camera's height is of, median error [px]" "" "$(told "foot on the pavement, median error \\[px\\]")" ""
  cells "town-loop, seed $seed" "$frames" "$(told boxes)" "of those truly hidden" "" "$(told "hidden pixels right")" ""
done
printf '\nBoxes of 0.6 x 0.6 x 1.8 m on a grid from 7 to 19 m ahead, wherever nothing solid stands; camera and height above the road are known. The model has learned from rendered towns of other seeds.\n' >> "$rows"
