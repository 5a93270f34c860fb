# cube_planar200: one camera over a plane.
title="cube_planar200: monocular over a plane"
s=$data/sequences/cube_planar200
[ -d "$s" ] || { absent "$title"; return 0; }
run cube "$s" --sensor mono
judge cube "$s" "$out/cube/trajectory_optimized.kitti" --align scale --lengths 0.5,1 --step 1
heading "$title"
command_line "placegraph run \$DATA/sequences/cube_planar200 --sensor mono --out OUT"
command_line "placegraph eval \$DATA/sequences/cube_planar200 OUT/trajectory_optimized.kitti --align scale --lengths 0.5,1 --step 1"
table
f=$out/cube.json
row "posed frames" - - - "200" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = 200)"
row "ATE RMSE [m]" scale - - "<= 0.01" "$(digits "$(number "$f" ate_rmse_m)" 4)" "$(verdict "$(number "$f" ate_rmse_m)" "<=" 0.01)"
row "t_rel [%]" scale 0.5,1 1 - "$(digits "$(number "$f" t_rel_percent)")" -
cost cube
