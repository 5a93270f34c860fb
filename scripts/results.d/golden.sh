# The evaluator against published rows of KITTI 00.
title="Evaluator: published rows of KITTI 00"
[ -d "$data/golden" ] || { absent "$title"; return 0; }
heading "$title"
command_line "placegraph eval \$DATA/golden/KITTI_00_gt.txt \$DATA/golden/KITTI_00_{ORB,SPTAM}.txt"
table
for entry in "ORB 0.69973 0.25333 1.30345 0.93771" "SPTAM 1.48696 0.55771 3.73849 3.63529"; do
  set -- $entry
  judge "golden-$1" "$data/golden/KITTI_00_gt.txt" "$data/golden/KITTI_00_$1.txt"
  judge "golden-$1-sim3" "$data/golden/KITTI_00_gt.txt" "$data/golden/KITTI_00_$1.txt" --align sim3
  f=$out/golden-$1.json
  for figure in "t_rel_percent $2" "r_rel_deg_per_100m $3" "ate_rmse_m $4" "sim3 $5"; do
    key=${figure% *}; want=${figure#* }; align=se3; file=$f
    [ "$key" != sim3 ] || { key=ate_rmse_m; align=sim3; file=$out/golden-$1-sim3.json; }
    value=$(number "$file" "$key")
    row "$1 $key" $align 100,...,800 10 "$want +- 5e-5" "$(digits "$value" 5)" \
      "$(verdict "$(LC_ALL=C awk -v a="$value" -v b="$want" 'BEGIN { d = a - b; print d < 0 ? -d : d }')" "<=" 5e-5)"
  done
done
