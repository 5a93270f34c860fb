# town-loop, rendered: what scripts/demo shows.
render_town
world=$out/town-world
run town-no-loops "$world" --no-loops
run town "$world"
heading "The rendered town: what scripts/demo shows"
command_line "placegraph synth sequence town-loop --out WORLD --difficulty standard"
command_line "placegraph run WORLD --out OUT [--no-loops]"
command_line "placegraph eval WORLD OUT/trajectory_optimized.kitti --align se3"
table
judge town-no-loops "$world" "$out/town-no-loops/trajectory_optimized.kitti" --align se3
judge town "$world" "$out/town/trajectory_optimized.kitti" --align se3
row "frames" - - - ">= 600" "$(number "$out/town.json" frames)" "$(verdict "$(number "$out/town.json" frames)" ">=" 600)"
row "ATE over the path, --no-loops [%]" se3 - - "<= 2" "$(digits "$(number "$out/town-no-loops.json" ate_percent_of_path)")" "$(verdict "$(number "$out/town-no-loops.json" ate_percent_of_path)" "<=" 2)"
row "ATE over the path, with loops [%]" se3 - - "<= 0.5" "$(digits "$(number "$out/town.json" ate_percent_of_path)")" "$(verdict "$(number "$out/town.json" ate_percent_of_path)" "<=" 0.5)"
row "ATE RMSE, --no-loops / with loops [m]" se3 - - - "$(digits "$(number "$out/town-no-loops.json" ate_rmse_m)") / $(digits "$(number "$out/town.json" ate_rmse_m)")" -
row "loops accepted" - - - - "$(number "$out/town/result.json" loops_accepted)" -
cost town
