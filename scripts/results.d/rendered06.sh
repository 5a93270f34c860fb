# KITTI 06, rendered.
title="KITTI 06 rendered (standard): one eye, camera height 1.65 m"
s=$data/kitti_gt/06/poses.txt
[ -f "$s" ] || { absent "$title"; return 0; }
render_kitti06
run rendered06 "$out/rendered06-world" --sensor mono --camera-height 1.65
judge rendered06 "$out/rendered06-world" "$out/rendered06/trajectory_optimized.kitti" --align origin
judge rendered06-online "$out/rendered06-world" "$out/rendered06/trajectory_online.kitti" --align origin
heading "$title"
command_line "placegraph synth \$DATA/kitti_gt/06/poses.txt --out WORLD --difficulty standard --mono"
command_line "placegraph run WORLD --sensor mono --camera-height 1.65 --out OUT"
command_line "placegraph eval WORLD OUT/trajectory_optimized.kitti --align origin"
table
f=$out/rendered06.json; r=$out/rendered06/result.json
row "posed frames" - - - - "$(number "$f" posed) of $(number "$f" frames)" -
row "loops accepted" - - - ">= 1" "$(number "$r" loops_accepted)" "$(verdict "$(number "$r" loops_accepted)" ">=" 1)"
row "ATE RMSE after optimization [m]" origin - - "<= 4" "$(digits "$(number "$f" ate_rmse_m)")" "$(verdict "$(number "$f" ate_rmse_m)" "<=" 4)"
row "ATE RMSE online [m]" origin - - - "$(digits "$(number "$out/rendered06-online.json" ate_rmse_m)")" -
row "t_rel [%]" origin 100,...,800 10 - "$(digits "$(number "$f" t_rel_percent)")" -
cost rendered06
