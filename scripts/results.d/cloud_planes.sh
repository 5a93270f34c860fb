# Planes in point clouds with exact labels: found by normalized cuts and by the two baselines.
title="Planes in point clouds: castle_rgbd, planes_synpeb, generated clouds"
s=$data/scene
[ -d "$s/castle_rgbd" ] && [ -d "$s/planes_synpeb" ] || { absent "$title"; return 0; }
build_bench bench_cloud_planes_study
heading "$title"
study=build/release/tests/bench/bench_cloud_planes_study
command_line "$study castle \$DATA/scene/castle_rgbd"
command_line "$study synpeb \$DATA/scene/planes_synpeb/test_100_xyzlabel.txt"
command_line "$study generated 5"
prose << 'NOTE'
`castle`: 20 depth images of 640x480 of a model 0.2 m high, planes of 300 px or more; coplanar faces count as one, a
window and a door belong to their wall. `synpeb`: a range scan of 10,000 points, taken as points without order, planes
of 100 points or more. `generated`: 20 clouds of 0.3 to 60 m with curved surfaces, on none of which planarity was
trained. The added noise lies along the ray: in mm for the castle, in % of the range for the scan; the generated clouds
have their own.
NOTE
prose << 'NOTE'
Correct: a found region and a plane hold 80 % of each other (Hoover et al. 1996). In pieces: the share of the
planes that several found regions hold. Joined: found regions that hold several planes. False: found regions of that
size that are none of these. The same options are used everywhere.
NOTE
columns data noise method planes correct share "in pieces" joined missed false
$study castle "$s/castle_rgbd" > "$out/cloud_planes.tsv"
$study synpeb "$s/planes_synpeb/test_100_xyzlabel.txt" | tail -n +2 >> "$out/cloud_planes.tsv"
$study generated 5 | tail -n +2 | awk -F '\t' '$2 == 0' >> "$out/cloud_planes.tsv"
tail -n +2 "$out/cloud_planes.tsv" > "$out/cloud_planes.rows"
while IFS='	' read -r name noise method planes correct share over under missed false rest; do
  unit=mm; [ "$name" = castle ] || unit=%
  cells "$name" "$noise $unit" "$method" "$planes" "$correct" "$share" "$over" "$under" "$missed" "$false"
done < "$out/cloud_planes.rows"
columns data noise method "normal, median [deg]" "worst [deg]" "CPU a cloud, median [ms]"
while IFS='	' read -r name noise method planes correct share over under missed false median worst ms; do
  unit=mm; [ "$name" = castle ] || unit=%
  [ "$name" = castle ] || { median=-; worst=-; }
  cells "$name" "$noise $unit" "$method" "$median" "$worst" "$ms"
done < "$out/cloud_planes.rows"
# study_value DATA NOISE METHOD COLUMN
study_value() { awk -F '\t' -v d="$1" -v n="$2" -v m="$3" -v c="$4" '$1 == d && $2 == n && $3 == m { print $c }' "$out/cloud_planes.rows"; }
columns figure target measured met
value=$(study_value castle 0 cuts 6); cells "castle, correct" ">= 0.90" "$value" "$(verdict "$value" ">=" 0.90)"
value=$(study_value castle 0 cuts 7); cells "castle, in pieces a plane" "<= 0.1" "$value" "$(verdict "$value" "<=" 0.1)"
value=$(study_value castle 0 cuts 12); cells "castle, normals, worst [deg]" "<= 1" "$value" "$(verdict "$value" "<=" 1)"
value=$(study_value synpeb 0 cuts 5); cells "synpeb, correct of 10" ">= 9" "$value" "$(verdict "$value" ">=" 9)"
value=$(study_value castle 0 cuts 13); cells "castle, CPU a depth image [ms]" "<= 150" "$value" "$(verdict "$value" "<=" 150)"
for name in castle synpeb; do
  for noise in 0 1 2; do
    ours=$(study_value $name $noise cuts 5)
    for other in ransac growing; do
      theirs=$(study_value $name $noise $other 5)
      cells "$name, noise $noise: correct, against $other" ">= $theirs" "$ours" "$(verdict "$ours" ">=" "$theirs")"
    done
  done
done
