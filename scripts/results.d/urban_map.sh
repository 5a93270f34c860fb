# Maps of what is where in a street: a rendered town against its true scene, before and after loops
# corrected it; the top view of a real street.
title="Semantic maps of streets"
heading "$title"
command_line "placegraph synth town-loop --seed SEED --labels --out TOWN"
command_line "placegraph run TOWN --sensor stereo --scene semantics --out OUT"
echo >> "$rows"
echo "Cells of 0.3 m whose class is one that truly stands there, of all that are known, by the first pose: nothing is fitted. \`before\`" >> "$rows"
echo "lays the sights out by the poses as they stood when each frame was done, \`after\` by those of the finished map. **photographs**: the" >> "$rows"
echo "models that come with the program (CamVid, colour). **rendered**: models of the same kind learned from the left eyes of four other towns" >> "$rows"
echo "(seeds 21 to 24, every eighth of the first 400 frames each):" >> "$rows"
echo >> "$rows"
command_line "placegraph synth town-loop --seed SEED --mono --labels --frames 400 --out LESSON      # images/, labels/ of train/: every eighth"
command_line "placegraph train urban LESSONS --out urban.pgscene --variants 3; placegraph train surfaces LESSONS --out surfaces.pgscene --variants 3"
lessons=$out/urban-lessons
if [ ! -f "$out/urban_rendered.pgscene" ] || [ ! -f "$out/surfaces_rendered.pgscene" ]; then
  rm -rf "$lessons"; mkdir -p "$lessons/train/images" "$lessons/train/labels"
  for seed in 21 22 23 24; do
    render "urban-lesson-$seed" town-loop --seed $seed --mono --labels --frames 400
    world=$out/urban-lesson-$seed-world
    cp "$world/CLASSES.txt" "$lessons/CLASSES.txt"
    for image in "$world"/image_0/*.png; do
      name=$(basename "$image"); index=$(echo "${name%.png}" | sed 's/^0*//')
      [ $((${index:-0} % 8)) = 0 ] || continue
      cp "$image" "$lessons/train/images/t${seed}_$name"
      cp "$world/labels_0/$name" "$lessons/train/labels/t${seed}_$name"
    done
  done
  $placegraph train urban "$lessons" --out "$out/urban_rendered.pgscene" --variants 3 --force
  $placegraph train surfaces "$lessons" --out "$out/surfaces_rendered.pgscene" --variants 3 --force
fi
columns world models correction cells "right [%]" "of most surface [%]" "nothing there [%]" "top view right [%]" target met
score() { # score FILE CORRECTION GROUP FIELD
  awk -v when="\"$2\"" -v group="\"$3\"" -v field="\"$4\"" '
    index($0, "\"check\":") { on = 1 }
    on && index($0, when ":") { at = 1 }
    on && at && index($0, group ":") { inside = 1 }
    inside && index($0, field ":") { gsub(/[^0-9.e+-]/, "", $2); print $2; exit }' "$1"
}
percent() { awk -v v="$1" 'BEGIN { printf "%.1f", 100 * v }'; }
for seed in 1 5; do
  town=urban-town-$seed
  render "$town" town-loop --seed $seed --stereo --labels
  for models in photographs rendered; do
    name=$town-$models
    case $models in
      rendered) with="--set scene.urban_model=$out/urban_rendered.pgscene --set scene.surfaces_model=$out/surfaces_rendered.pgscene" ;;
      *) with= ;;
    esac
    run "$name" "$out/$town-world" --sensor stereo --scene semantics $with
    f=$out/$name/result.json
    for when in online optimized; do
      case $when in online) said=before ;; *) said=after ;; esac
      right=$(percent "$(score "$f" $when all right_share)")
      cells "town-loop, seed $seed" "$models" "$said" "$(score "$f" $when all cells)" "$right" \
        "$(percent "$(score "$f" $when all most_share)")" "$(percent "$(score "$f" $when all nothing_share)")" \
        "$(percent "$(score "$f" $when top right_share)")" ">= 90" "$(verdict "$right" ">=" 90)"
    done
  done
done
s=$data/sequences/kitti06_stereo51
if [ -d "$s" ]; then
  run urban-kitti06 "$s" --sensor stereo --scene semantics
  mkdir -p docs/images
  cp "$out/urban-kitti06/semantic_map.png" docs/images/urban_map_kitti06.png
  printf '\n![kitti06_stereo51 from above](images/urban_map_kitti06.png)\n' >> "$rows"
fi
