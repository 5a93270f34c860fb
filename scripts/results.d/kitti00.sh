# kitti00_mono200: one camera of known height.
title="kitti00_mono200: monocular, camera height 1.65 m"
s=$data/sequences/kitti00_mono200
[ -d "$s" ] || { absent "$title"; return 0; }
run kitti00 "$s" --sensor mono --camera-height 1.65
judge kitti00 "$s" "$out/kitti00/trajectory_optimized.kitti" --align origin --lengths 50,60,70,80,90,100 --step 1
heading "$title"
command_line "placegraph run \$DATA/sequences/kitti00_mono200 --sensor mono --camera-height 1.65 --out OUT"
command_line "placegraph eval \$DATA/sequences/kitti00_mono200 OUT/trajectory_optimized.kitti --align origin --lengths 50,60,70,80,90,100 --step 1"
table
f=$out/kitti00.json
row "posed frames" - - - "200" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = 200)"
row "t_rel [%]" origin 50,60,...,100 1 "<= 4" "$(digits "$(number "$f" t_rel_percent)")" "$(verdict "$(number "$f" t_rel_percent)" "<=" 4)"
row "median frame-to-frame rotation error [deg]" origin - - "<= 0.1" "$(digits "$(number "$f" rpe_rot_median_deg)" 4)" "$(verdict "$(number "$f" rpe_rot_median_deg)" "<=" 0.1)"
row "ATE RMSE [m]" origin - - - "$(digits "$(number "$f" ate_rmse_m)")" -
cost kitti00
