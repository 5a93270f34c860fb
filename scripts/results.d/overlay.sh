# A box placed in the images of rendered towns, against where it would truly be seen.
# OVERLAY_FRAMES other than 40 a town.
frames=${OVERLAY_FRAMES:-40}
build_bench bench_overlay_study
heading "Contextual overlay"
command_line "build/release/tests/bench/bench_overlay_study configs/models/surfaces.pgscene OUT SEED $frames"
columns world frames boxes figure target measured met
for seed in 1 5; do
  say "overlay: town $seed"
  build/release/tests/bench/bench_overlay_study configs/models/surfaces.pgscene "$out/overlay-$seed" $seed "$frames" > "$out/overlay-$seed.log"
  # value_of FIGURE
  value_of() { sed -n "s/^$1	//p" "$out/overlay-${seed}_targets.tsv"; }
  # figure NAME TARGET OPERATOR BOUND WHICH
  figure() { cells "town-loop, seed $seed" "$frames" "$(value_of boxes)" "$1" "$2 $3" "$(value_of "$4")" "$(verdict "$(value_of "$4")" "$2" "$3")"; }
  figure "horizon, median error [deg]" "<=" 1 "horizon, median error \[deg\]"
  figure "foot of the box on a level plane, median error [px]" "<=" 3 "foot on a level plane, median error \[px\]"
  figure "foot of the box on the uneven road, median error [px]" "<=" 3 "foot on the road, median error \[px\]"
  cells "town-loop, seed $seed" "$frames" "$(value_of boxes)" "the same with the true horizon [px]" "" "$(value_of "foot on the road by the true horizon, median error \[px\]")" ""
  figure "pixels of the box correctly seen or hidden" ">=" 0.9 "pixels right"
  cells "town-loop, seed $seed" "$frames" "$(value_of boxes)" "foot of the box on the raised pavement, median error [px]" "" "$(value_of "foot on the pavement, median error \\[px\\]")" ""
  cells "town-loop, seed $seed" "$frames" "$(value_of boxes)" "hidden pixels correctly hidden" "" "$(value_of "hidden pixels right")" ""
done
prose << 'NOTE'
Boxes of 0.6 x 0.6 x 1.8 m stand on a grid from 7 to 19 m ahead, wherever nothing solid stands. The camera and its
height above the road are known; the pavement is higher than the road that the height refers
to. The model was
trained on rendered towns of other seeds.
NOTE
