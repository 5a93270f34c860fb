# Motion memory over whole rendered drives.
title="Motion from images: KITTI 06 rendered (standard), two eyes, with loops"
s=$data/kitti_gt/06/poses.txt
[ -f "$s" ] || { absent "$title"; return 0; }
render stereo06 "$s" --difficulty standard --stereo
run stereo06 "$out/stereo06-world" --sensor stereo
judge stereo06 "$out/stereo06-world" "$out/stereo06/trajectory_optimized.kitti" --align se3
heading "$title"
command_line "placegraph synth \$DATA/kitti_gt/06/poses.txt --out WORLD --difficulty standard --stereo"
command_line "placegraph run WORLD --sensor stereo --out OUT"
command_line "placegraph eval WORLD OUT/trajectory_optimized.kitti --align se3"
table
f=$out/stereo06.json; r=$out/stereo06/result.json
row "posed frames" - - - "1101" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = 1101)"
row "loops accepted" - - - ">= 1" "$(number "$r" loops_accepted)" "$(verdict "$(number "$r" loops_accepted)" ">=" 1)"
row "ATE RMSE [m] (best peer, on another rendering: 0.80)" se3 - - "<= 0.6" "$(digits "$(number "$f" ate_rmse_m)")" "$(verdict "$(number "$f" ate_rmse_m)" "<=" 0.6)"
row "t_rel [%] (0.25)" se3 100,...,800 10 "<= 0.22" "$(digits "$(number "$f" t_rel_percent)")" "$(verdict "$(number "$f" t_rel_percent)" "<=" 0.22)"
cost stereo06
