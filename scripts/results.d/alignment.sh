# Direct alignment of planar templates: from how far an initialization converges. ALIGNMENT_TRIALS other than 20.
trials=${ALIGNMENT_TRIALS:-20}
build_bench bench_align_study
study=build/release/tests/bench/bench_align_study
# value_of WHAT: a figure of the targets
value_of() { sed -n "s/^$1	//p" "$out/alignment_rendered_targets.tsv"; }
# pictures NAME: into docs/images
pictures() {
  for by in optimizers similarities; do
    cp "$out/alignment_$1_$by.png" "docs/images/alignment_$1_$by.png"
    picture "trials that converged, $1, by $by" "alignment_$1_$by.png"
  done
}

heading "Direct alignment: from how far it converges"
command_line "build/release/tests/bench/bench_align_study out/rendered $trials"
command_line "build/release/tests/bench/bench_align_study out/photos $trials \$DATA/scene/planar_homography"
say "alignment: rendered templates"
$study "$out/alignment_rendered" "$trials" 2> "$out/alignment_rendered.log"
columns figure target measured met
steps=$(value_of "steps of ESM to 0.01 px from 4 px, median of 40")
cells "steps of ESM from 4 px to 0.01 px, rendered, median of 40" "<= 6" "$steps" "$(verdict "$steps" "<=" 6)"
cells "error after six steps, median [px]" "<= 0.01" "$(value_of "error after 6 steps, median \[px\]")" "$(verdict "$(value_of "error after 6 steps, median \[px\]")" "<=" 0.01)"
cells "within 0.01 px after six steps [%]" - "$(value_of "share within 6 steps \[%\]")" -
cells "ESM: 90 % of 60 converge from [px]" - "$(value_of "esm at 90 % \[px\]")" -
cells "swarm and ESM: 90 % of 60 converge from [px], at least" "1.5 times that" "$(value_of "swarm_esm at 90 % \[px\]") ($(value_of ratio) times)" "$(verdict "$(value_of ratio)" ">=" 1.5)"
prose << NOTE
Grey values are rounded in both images. The tables have the offset [px] up to which at least 90 % of the trials end within
a pixel (photographs: three), in steps of 4 to 40, of searches (swarm, genetic, swarm and ESM) in steps of 8; 0: fewer
than 90 % converge from the smallest offset. Every corner of a template of 80x80 px begins that far off, each in a
direction of its own, on three levels, in $trials trials for each offset. \`wrong but ok\`: trials that ended elsewhere
although their outcome reports success.
NOTE
prose 'Rendered templates:'
gap
cat "$out/alignment_rendered.md" >> "$rows"
pictures rendered
if [ -d "$data/scene/planar_homography" ]; then
  say "alignment: photographs"
  $study "$out/alignment_photos" "$trials" "$data/scene/planar_homography" 2> "$out/alignment_photos.log"
  prose 'Photographs (graf, leuven, boat: the first with the second and the third):'
  gap
  cat "$out/alignment_photos.md" >> "$rows"
  pictures photos
fi
