# sevenscenes_rgbd334: hand-held depth camera.
title="sevenscenes_rgbd334: hand-held RGB-D"
s=$data/sequences/sevenscenes_rgbd334
[ -d "$s" ] || { absent "$title"; return 0; }
run sevenscenes "$s" --sensor rgbd
judge sevenscenes "$s" "$out/sevenscenes/trajectory_optimized.kitti" --align se3 --lengths 1,2,4,8 --step 1
heading "$title"
command_line "placegraph run \$DATA/sequences/sevenscenes_rgbd334 --sensor rgbd --out OUT"
command_line "placegraph eval \$DATA/sequences/sevenscenes_rgbd334 OUT/trajectory_optimized.kitti --align se3 --lengths 1,2,4,8 --step 1"
table
f=$out/sevenscenes.json; r=$out/sevenscenes/result.json
row "posed frames" - - - "334" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = 334)"
row "ATE RMSE [m]" se3 - - "<= 0.10" "$(digits "$(number "$f" ate_rmse_m)" 4)" "$(verdict "$(number "$f" ate_rmse_m)" "<=" 0.1)"
row "true loops (within 10 cm and 5 deg, >= 33 frames apart)" - - - ">= 20" "$(number "$r" true_loops)" "$(verdict "$(number "$r" true_loops)" ">=" 20)"
row "false loops" - - - "0" "$(number "$r" false_loops)" "$(verdict "$(number "$r" false_loops)" = 0)"
row "t_rel [%]" se3 1,2,4,8 1 - "$(digits "$(number "$f" t_rel_percent)")" -
cost sevenscenes
