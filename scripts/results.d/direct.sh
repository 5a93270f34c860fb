# Surfaces alone and beside points: each cue alone, and together.
title="Surfaces: motion by grey values"
s=$data/sequences
heading "$title"
command_line "placegraph run SEQUENCE --out OUT --sensor SENSOR --cues CUES --no-loops [--camera-height METRES]"
command_line "placegraph eval SEQUENCE OUT/trajectory_optimized.kitti --align ALIGN --lengths LENGTHS --step STEP"
columns sequence sensor cues "posed frames" align "ATE RMSE [m]" "lengths [m], step" "t_rel [%]" "r_rel [deg/100 m]" "RPE rot median [deg]" "CPU a frame [ms]" "target met"
# direct_row NAME SEQUENCE SENSOR CUES ALIGN LENGTHS STEP LIMIT ARGUMENTS...
direct_row() {
  name=$1 sequence=$2 sensor=$3 cues=$4 align=$5 lengths=$6 step=$7 limit=$8
  shift 8
  run "$name" "$sequence" --sensor "$sensor" --cues "$cues" --no-loops "$@"
  judge "$name" "$sequence" "$out/$name/trajectory_optimized.kitti" --align "$align" --lengths "$lengths" --step "$step"
  f=$out/$name.json; r=$out/$name/result.json
  met=-
  [ "$limit" = - ] || met="t_rel <= $limit: $(verdict "$(number "$f" t_rel_percent)" "<=" "$limit")"
  cells "$(basename "$sequence")" "$sensor" "$cues" "$(number "$f" posed) of $(number "$r" frames)" "$align" \
    "$(digits "$(number "$f" ate_rmse_m)" 4)" "$lengths, $step" "$(digits "$(number "$f" t_rel_percent)")" "$(digits "$(number "$f" r_rel_deg_per_100m)")" \
    "$(digits "$(number "$f" rpe_rot_median_deg)" 4)" \
    "$(LC_ALL=C awk -v c="$(number "$r" cpu_s)" -v n="$(number "$r" frames)" 'BEGIN { printf "%.1f", 1000 * c / n }')" "$met"
}
every_way="plane direct points points,plane points,plane,direct"
for cues in $every_way; do
  limit=-; [ "$cues" != plane ] || limit=5
  [ ! -d "$s/kitti06_stereo51" ] ||
    direct_row "direct-kitti06-$cues" "$s/kitti06_stereo51" stereo $cues origin 10,20,30,40,50 1 $limit
done
for sequence in kitti00_mono200 kitti0095_mono268; do
  for cues in plane points,plane; do
    limit=-; [ "$cues" != plane ] || limit=5
    [ ! -d "$s/$sequence" ] ||
      direct_row "direct-$sequence-$cues" "$s/$sequence" mono $cues origin 10,20,30,40,50 1 $limit --camera-height 1.65
  done
done
for cues in $every_way; do
  [ ! -d "$s/sevenscenes_rgbd334" ] ||
    direct_row "direct-7scenes-$cues" "$s/sevenscenes_rgbd334" rgbd $cues se3 0.5,1,2 1 -
done
render direct-town town-loop --difficulty standard --frames 200
for cues in $every_way; do
  limit=-; [ "$cues" != plane ] || limit=5
  direct_row "direct-town-$cues" "$out/direct-town-world" stereo $cues origin 10,20,40,80 5 $limit
done
