# KITTI drives on the earth by simulated GPS fixes.

# georeferenced NAME KITTI_GT DROPOUTS "time|line [WALKS]" SEEDS ARGUMENTS...: for every seed from 1 one line "outside inside" in $out/NAME.txt
georeferenced() {
  name=$1; kitti=$2; dropouts=$3; reference=$4; seeds=$5; shift 5
  : > "$out/$name.txt"
  for seed in $(seq "$seeds"); do
    w=$out/$name-$seed
    build/release/make_gps_scenario "$kitti" "$w" "$seed" "$dropouts" $reference
    $placegraph map georeference "$w/odometry.g2o" --times "$w/times.txt" --gps "$w/oxts.txt" --lever-arm=-0.32,0.72,-1.08 \
      --origin "$(cat "$w/origin.txt")" --out "$w/earth" --force "$@" > "$w.log"
    for part in outside inside; do
      $placegraph eval "$w/$part.tum" "$w/earth/trajectory_enu.tum" --align none --json > "$w-$part.json" 2> "$w-$part.err"
    done
    echo "$(number "$w-outside.json" ate_rmse_m) $(number "$w-inside.json" ate_rmse_m)" >> "$out/$name.txt"
  done
  $placegraph eval "$kitti/poses.txt" "$out/$name-1/odometry.kitti" --json > "$out/$name-odometry.json" 2> "$out/$name-odometry.err"
}
# of_seeds FILE COLUMN: "RMS median largest" over the seeds
of_seeds() {
  awk -v c="$2" '{ print $c }' "$1" | LC_ALL=C sort -g | LC_ALL=C awk '{ v[NR] = $1; s += $1 * $1 }
    END { printf "%.3f %.3f %.3f", sqrt(s / NR), NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2, v[NR] }'
}
# seeds_row WHERE FILE COLUMN LIMIT
seeds_row() {
  set -- "$1" "$4" $(of_seeds "$2" "$3")
  cells "position RMSE $1 [m]" "all <= $2" "$3 / $4 / $5" "$(verdict "$3" "<=" "$2")"
}

for drive in 00 06; do
  title="KITTI $drive georeferenced by GPS"
  s=$data/kitti_gt/$drive
  [ -f "$s/oxts.txt" ] || { absent "$title"; continue; }
  say "georeferencing KITTI $drive"
  if [ "$drive" = 00 ]; then spans=100-200,300-400; else spans=40-80; fi
  georeferenced "gps$drive" "$s" "$spans" time 10
  georeferenced "gps$drive-clock" "$s" "$spans" line 10 --clock-offset estimate
  [ "$drive" != 00 ] || georeferenced "gps$drive-harder" "$s" "$spans" "time 0.041 8.8e-4" 10
  heading "$title"
  command_line "make_gps_scenario \$DATA/kitti_gt/$drive W SEED $spans time|line    # of the build"
  command_line "placegraph map georeference W/odometry.g2o --times W/times.txt --gps W/oxts.txt --lever-arm=-0.32,0.72,-1.08 --origin \$(cat W/origin.txt) [--clock-offset estimate] --out W/earth"
  command_line "placegraph eval W/outside.tum W/earth/trajectory_enu.tum --align none    # and W/inside.tum"
  prose << 'NOTE'
The fixes have 1 m of noise, 5 % gross errors and dropouts; the odometry drifts by 1 %
(`tests/support/gps_scenario.h`). A row of three figures has the position RMSE over all of 10 seeds, their median and
the largest; only the first is judged, without alignment. Where the clock is estimated, truth and readings are
paired line by line (`line`), else by their times (`time`). t_rel is that of the odometry, over 100,...,800 m with step 10.
NOTE
  columns figure target measured met
  for how in "" -clock; do
    f=$out/gps$drive$how.txt
    if [ -z "$how" ]; then clock="clocks as they stand"; else clock="clock estimated"; fi
    seeds_row "outside dropouts, $clock" "$f" 1 0.3
    seeds_row "inside dropouts, $clock" "$f" 2 2
  done
  cells "t_rel of the odometry of seed 1 [%]" - "$(digits "$(number "$out/gps$drive-odometry.json" t_rel_percent)")" -
  if [ "$drive" = 00 ]; then
    seeds_row "outside dropouts, stronger drift" "$out/gps00-harder.txt" 1 0.3
    seeds_row "inside dropouts, stronger drift" "$out/gps00-harder.txt" 2 2
    cells "t_rel of the odometry with stronger drift, seed 1 [%]" - "$(digits "$(number "$out/gps00-harder-odometry.json" t_rel_percent)")" -
  fi
  cells "fixes rejected, seed 1" - "$(number "$out/gps$drive-1/earth/georeference.json" fixes_rejected) of $(number "$out/gps$drive-1/earth/georeference.json" fixes)" -
  cells "CPU of the optimization, seed 1 [ms]" - "$(digits "$(number "$out/gps$drive-1/earth/georeference.json" cpu_ms)" 0)" -
  [ "$drive" != 00 ] || prose 'Stronger drift: random walks of 0.041 and 8.8e-4, so that t_rel is 1 % on this drive.'
done
