# kitti0095_mono268: one camera of known height in city traffic.
title="kitti0095_mono268: monocular, camera height 1.65 m, city traffic"
s=$data/sequences/kitti0095_mono268
[ -d "$s" ] || { absent "$title"; return 0; }
run kitti0095 "$s" --sensor mono --camera-height 1.65
judge kitti0095 "$s" "$out/kitti0095/trajectory_optimized.kitti" --align origin --lengths 50,100,150,200 --step 1
heading "$title"
command_line "placegraph run \$DATA/sequences/kitti0095_mono268 --sensor mono --camera-height 1.65 --out OUT"
command_line "placegraph eval \$DATA/sequences/kitti0095_mono268 OUT/trajectory_optimized.kitti --align origin --lengths 50,100,150,200 --step 1"
table
f=$out/kitti0095.json
row "posed frames" - - - - "$(number "$f" posed)" -
row "t_rel [%]" origin 50,100,150,200 1 - "$(digits "$(number "$f" t_rel_percent)")" -
row "ATE RMSE [m]" origin - - - "$(digits "$(number "$f" ate_rmse_m)")" -
cost kitti0095
