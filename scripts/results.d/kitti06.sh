# kitti06_stereo51: stereo, and its repeatability.
title="kitti06_stereo51: stereo"
s=$data/sequences/kitti06_stereo51
[ -d "$s" ] || { absent "$title"; return 0; }
run kitti06 "$s" --sensor stereo
judge kitti06 "$s" "$out/kitti06/trajectory_optimized.kitti" --align origin --lengths 10,20,30,40,50 --step 1
heading "$title"
command_line "placegraph run \$DATA/sequences/kitti06_stereo51 --sensor stereo --out OUT"
command_line "placegraph eval \$DATA/sequences/kitti06_stereo51 OUT/trajectory_optimized.kitti --align origin --lengths 10,20,30,40,50 --step 1"
table
f=$out/kitti06.json
row "posed frames" - - - - "$(number "$f" posed) of 51" -
row "t_rel [%]" origin 10,20,...,50 1 "<= 2" "$(digits "$(number "$f" t_rel_percent)")" "$(verdict "$(number "$f" t_rel_percent)" "<=" 2)"
row "ATE RMSE [m]" origin - - - "$(digits "$(number "$f" ate_rmse_m)")" -
cost kitti06

say "repeating kitti06 with 1 and 2 threads"
run kitti06-1 "$s" --sensor stereo --threads 1
run kitti06-2 "$s" --sensor stereo --threads 2
same=yes
for file in trajectory_online.kitti trajectory_optimized.kitti trajectory_online.tum trajectory_optimized.tum; do
  cmp -s "$out/kitti06/$file" "$out/kitti06-1/$file" && cmp -s "$out/kitti06/$file" "$out/kitti06-2/$file" || same="**no**"
done
heading "Repeatability: kitti06_stereo51 three times, with default, 1 and 2 threads"
command_line "placegraph run \$DATA/sequences/kitti06_stereo51 --sensor stereo --threads 1 --out OUT"
table
row "trajectories byte for byte the same" - - - "yes" "$same" "$same"
