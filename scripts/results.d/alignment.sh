# Direct alignment of planar templates: how far from the truth it may start. ALIGNMENT_TRIALS other than 20.
trials=${ALIGNMENT_TRIALS:-20}
build_bench bench_align_study
study=build/release/tests/bench/bench_align_study
# told WHAT: a figure of the targets
told() { sed -n "s/^$1	//p" "$out/alignment_rendered_targets.tsv"; }
# pictures NAME: into docs/images
pictures() {
  for by in optimizers similarities; do
    cp "$out/alignment_$1_$by.png" "docs/images/alignment_$1_$by.png"
    printf '\n![trials that converged, %s, by %s](images/alignment_%s_%s.png)\n' "$1" "$by" "$1" "$by" >> "$rows"
  done
}

heading "Alignment: how far from the truth it may start"
command_line "build/release/tests/bench/bench_align_study out/rendered $trials"
command_line "build/release/tests/bench/bench_align_study out/photos $trials \$DATA/scene/planar_homography"
say "alignment: rendered templates"
$study "$out/alignment_rendered" "$trials" > /dev/null 2> "$out/alignment_rendered.log"
columns figure target measured met
steps=$(told "steps of ESM to 0.01 px from 4 px, median of 40")
cells "steps of ESM from 4 px to 0.01 px, rendered, median of 40" "<= 6" "$steps" "$(verdict "$steps" "<=" 6)"
cells "error after six steps, median [px]" "<= 0.01" "$(told "error after 6 steps, median \[px\]")" "$(verdict "$(told "error after 6 steps, median \[px\]")" "<=" 0.01)"
cells "within 0.01 px after six steps [%]; greys are rounded in both images" - "$(told "share within 6 steps \[%\]")" -
cells "ESM: 90 % of 60 converge from [px]" - "$(told "esm at 90 % \[px\]")" -
cells "swarm and ESM: 90 % of 60 converge from [px], at least" "1.5 times that" "$(told "swarm_esm at 90 % \[px\]") ($(told ratio) times)" "$(verdict "$(told ratio)" ">=" 1.5)"
cat >> "$rows" <<EOF

The offset [px] up to which at least 90 % of the trials end within a pixel (photographs: three), in steps of 4 to 40, of searches (swarm, genetic, swarm and ESM) in steps of 8; every corner of a
template of 80x80 px starts that far off, each into a direction of its own, on three levels. "Wrong but ok": trials that ended elsewhere
and were not told so by the outcome. 0: fewer than 90 % from the smallest offset already. Trials an offset: $trials.

Rendered templates:

EOF
cat "$out/alignment_rendered.md" >> "$rows"
pictures rendered
if [ -d "$data/scene/planar_homography" ]; then
  say "alignment: photographs"
  $study "$out/alignment_photos" "$trials" "$data/scene/planar_homography" > /dev/null 2> "$out/alignment_photos.log"
  printf '\nPhotographs (graf, leuven, boat: the first with the second and the third):\n\n' >> "$rows"
  cat "$out/alignment_photos.md" >> "$rows"
  pictures photos
fi
