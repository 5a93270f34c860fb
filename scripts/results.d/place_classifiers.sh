# Labelled places: each cue alone and all together, by each classifier.
title="Labelled places"
house=$data/places/vtm_virtual_house
[ -d "$house" ] || { absent "$title"; return 0; }
heading "$title"
command_line "placegraph places classify \$DATA/places/vtm_virtual_house --out labels.txt --classifier CLASSIFIER --appearance CUES"
. scripts/results.d/place_sets.sh
prose 'Accuracy on the parts of the training half that were left out (which alone decides about weights and costs) / on the other half.'
columns cues kernel svm adaboost
for cues in colours quarters edges tiny gabor colours,quarters,edges,tiny,gabor; do
  set --
  for machine in kernel svm adaboost; do
    say "classifying places by $cues, $machine"
    $placegraph places classify "$house" --out "$out/places-labels.txt" --force --classifier $machine --appearance $cues > "$out/places-labels.log"
    left_out=$(sed -n 's/.*parts accuracy \([0-9.]*\),.*/\1/p' "$out/places-labels.log")
    last=$(classified_right "$out/places-labels.txt")
    set -- "$@" "$left_out / $(digits "$last")"
    [ "$machine" != kernel ] || kernel=$last
  done
  cells "$cues" "$@"
done
columns figure target measured met
cells "all cues, kernel" ">= 0.985" "$(digits "$kernel")" "$(verdict "$kernel" ">=" 0.985)"
