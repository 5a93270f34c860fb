# Manhattan frames of single images, and the heading of a run with and without them.
title="Manhattan frames and vanishing points"
york=$data/scene/york_urban_vp
[ -d "$york" ] || { absent "$title"; return 0; }
heading "$title"
prose 'Vanishing points found from the segments of single images (`york_urban_vp`), against those marked by people.'
command_line "integration_york_urban_tests"
cmake --build --preset release -j"$(nproc)" --target integration_york_urban_tests > "$out/york-build.log"
PLACEGRAPH_DATA=$data build/release/tests/integration/integration_york_urban_tests > "$out/york.txt" || true
columns measure target measured "target met"
# figure PATTERN: the number that follows it
figure() { sed -n "s/.*$1 \([0-9.]*\).*/\1/p" "$out/york.txt" | head -1; }
york_row() { cells "$1" "$3 $4" "$(digits "$2" 3)" "$(verdict "$2" "$3" "$4")"; }
york_row "rotation error, median [deg]" "$(figure 'error median')" "<=" 1.5
york_row "rotation error, 95 % [deg]" "$(figure 'deg, 95 %')" "<=" 4
york_row "marked vanishing points found within 2 deg" "$(figure recall)" ">=" 0.85
york_row "false vanishing points an image" "$(figure false)" "<=" 1

prose << 'NOTE'
The heading of a stereo run once round the rendered corridor without loop closing, against the truth from the first pose
on, without and with the cue `manhattan`. `beyond` is the share of the frames whose error exceeds the target.
NOTE
command_line "placegraph synth sequence corridor-loop --difficulty standard --stereo --depth --labels --out WORLD"
command_line "placegraph run WORLD --sensor stereo --cues CUES --no-loops --out OUT"
render heading corridor-loop --difficulty standard --stereo --depth --labels
# heading_errors TRUTH ESTIMATE: median, greatest and last error about the first camera's y [deg], and the share of frames beyond 0.5 deg [%]
heading_errors() {
  LC_ALL=C awk 'NR == FNR { for (i = 1; i <= 12; i++) truth[FNR, i] = $i; next }
    function entry(matrix, row, column) { return matrix[4 * row + column + 1] }
    {
      for (i = 1; i <= 12; i++) { e[i] = $i; g[i] = truth[FNR, i]; if (FNR == 1) { e0[i] = $i; g0[i] = g[i] } }
      # row 0 and row 2 of R_first_now of both, then of their quotient
      for (r = 0; r < 3; r++) for (c = 0; c < 3; c++) {
        a[r, c] = b[r, c] = 0
        for (k = 0; k < 3; k++) { a[r, c] += entry(e0, k, r) * entry(e, k, c); b[r, c] += entry(g0, k, r) * entry(g, k, c) }
      }
      x = z = 0
      for (k = 0; k < 3; k++) { x += a[0, k] * b[2, k]; z += a[2, k] * b[2, k] }
      yaw = atan2(x, z) * 180 / atan2(0, -1); if (yaw < 0) yaw = -yaw
      print yaw
    }' "$1" "$2" > "$out/heading.txt"
  last=$(tail -1 "$out/heading.txt")
  sort -g "$out/heading.txt" | LC_ALL=C awk -v last="$last" '{ v[NR] = $1; n += $1 > 0.5 }
    END { printf "%.3f %.3f %.3f %.1f\n", v[int((NR + 1) / 2)], v[NR], last, 100 * n / NR }'
}
columns cues "heading error, median [deg]" "at the end [deg]" "greatest [deg]" "target" met "beyond [%]"
for cues in points,plane points,plane,manhattan; do
  run "heading-$cues" "$out/heading-world" --sensor stereo --cues $cues --no-loops
  set -- $(heading_errors "$out/heading-world/poses.txt" "$out/heading-$cues/trajectory_optimized.kitti")
  cells "$cues" "$1" "$3" "$2" "<= 0.5" "$(verdict "$2" "<=" 0.5)" "$4"
done
