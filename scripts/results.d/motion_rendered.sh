# SLAM over whole rendered drives.
title="KITTI 06 rendered (standard), stereo, with loops"
s=$data/kitti_gt/06/poses.txt
[ -f "$s" ] || { absent "$title"; return 0; }
render stereo06 "$s" --difficulty standard --stereo
run stereo06 "$out/stereo06-world" --sensor stereo
judge stereo06 "$out/stereo06-world" "$out/stereo06/trajectory_optimized.kitti" --align se3
heading "$title"
command_line "placegraph synth sequence \$DATA/kitti_gt/06/poses.txt --out WORLD --difficulty standard --stereo"
command_line "placegraph run WORLD --sensor stereo --out OUT"
command_line "placegraph eval WORLD OUT/trajectory_optimized.kitti --align se3"
prose 'The peer (ORB-SLAM2) ran on another rendering of the same path.'
table
f=$out/stereo06.json; r=$out/stereo06/result.json
row "posed frames" - - - "1101" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = 1101)"
row "loops accepted" - - - ">= 1" "$(number "$r" loops_accepted)" "$(verdict "$(number "$r" loops_accepted)" ">=" 1)"
row "ATE RMSE [m] (best peer: 0.80)" se3 - - "<= 0.6" "$(digits "$(number "$f" ate_rmse_m)")" "$(verdict "$(number "$f" ate_rmse_m)" "<=" 0.6)"
row "t_rel [%] (best peer: 0.25)" se3 100,...,800 10 "<= 0.22" "$(digits "$(number "$f" t_rel_percent)")" "$(verdict "$(number "$f" t_rel_percent)" "<=" 0.22)"
cost stereo06

# mono_drive NAME DRIVE FRAMES LIMIT PEER: one camera of known height over a whole rendered drive
mono_drive() {
  title="KITTI $2 rendered (standard), monocular, camera height 1.65 m, with loops"
  render "$1" "$data/kitti_gt/$2/poses.txt" --difficulty standard --mono
  run "$1" "$out/$1-world" --sensor mono --camera-height 1.65
  judge "$1" "$out/$1-world" "$out/$1/trajectory_optimized.kitti" --align origin
  heading "$title"
  command_line "placegraph synth sequence \$DATA/kitti_gt/$2/poses.txt --out WORLD --difficulty standard --mono"
  command_line "placegraph run WORLD --sensor mono --camera-height 1.65 --out OUT"
  command_line "placegraph eval WORLD OUT/trajectory_optimized.kitti --align origin"
  table
  f=$out/$1.json; r=$out/$1/result.json
  row "posed frames" - - - "$3" "$(number "$f" posed)" "$(verdict "$(number "$f" posed)" = "$3")"
  row "loops accepted" - - - ">= 1" "$(number "$r" loops_accepted)" "$(verdict "$(number "$r" loops_accepted)" ">=" 1)"
  row "ATE RMSE [m] ($5)" origin - - "<= $4" "$(digits "$(number "$f" ate_rmse_m)")" "$(verdict "$(number "$f" ate_rmse_m)" "<=" "$4")"
  row "t_rel [%]" origin 100,...,800 10 - "$(digits "$(number "$f" t_rel_percent)")" -
  cost "$1"
}
mono_drive rendered06 06 1101 3 "peers: lost for 263 frames, no scale"
mono_drive rendered00 00 4541 8 "ORB-SLAM2 on the real drive: 6 to 8 after Sim3"
