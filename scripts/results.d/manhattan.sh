# Directions of rectangular worlds in single images; what they are worth to motion is in `ablation`.
title="Directions of rectangular worlds"
york=$data/scene/york_urban_vp
[ -d "$york" ] || { absent "$title"; return 0; }
heading "$title"
echo "Segments of single images (\`york_urban_vp\`) against vanishing points that people marked." >> "$rows"
echo >> "$rows"
command_line "integration_vanishing_tests --gtest_filter='YorkUrban*'"
cmake --build --preset release -j2 --target integration_vanishing_tests > "$out/york-build.log"
PLACEGRAPH_DATA=$data build/release/tests/integration/integration_vanishing_tests --gtest_filter='YorkUrban*' > "$out/york.txt" || true
columns measure target measured "target met"
# figure PATTERN: the number that follows it
figure() { sed -n "s/.*$1 \([0-9.]*\).*/\1/p" "$out/york.txt" | head -1; }
york_row() { cells "$1" "$3 $4" "$(digits "$2" 3)" "$(verdict "$2" "$3" "$4")"; }
york_row "rotation error, median [deg]" "$(figure 'error median')" "<=" 1.5
york_row "rotation error, 95 % [deg]" "$(figure 'deg, 95 %')" "<=" 4
york_row "marked points found within 2 deg" "$(figure recall)" ">=" 0.85
york_row "false ones an image" "$(figure false)" "<=" 1
