// Segments of real pairs of views matched and held against the groups that people marked.
#include <gtest/gtest.h>
#include <placegraph/frontend/segments/segment_matcher.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/segment_file.h>

#include <algorithm>
#include <iostream>

#include "tests/support/data.h"
#include "tests/support/segment_groups.h"

namespace placegraph {
namespace line_matching_test {

struct Pair {
  const char *name, *image_a, *image_b, *number_b;
};
constexpr Pair kPairs[] = {{"building_rotation", "1.jpg", "2.jpg", "2"},
                           {"building_viewpoint", "1.png", "2.png", "2"},
                           {"dunster", "1.png", "2.png", "2"},
                           {"lowTexture", "1.jpg", "2.jpg", "2"},
                           {"outdoor_light", "1.jpg", "2.jpg", "2"},
                           {"shop_scale", "img1.png", "img6.png", "6"},
                           {"textureless_corridor", "1.png", "2.png", "2"}};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class LineMatching : public testing::TestWithParam<const char*> {};

TEST_P(LineMatching, IsPreciseAndFindsMostEdges) {
  PLACEGRAPH_DATA_OR_SKIP(root, "scene/line_matching");
  const std::string kind = GetParam();
  std::vector<double> precision, recall;
  for (const Pair& pair : kPairs) {
    const std::string folder = root + "/" + pair.name + "/";
    const SegmentMatches found = match_segments(
        read_image(folder + pair.image_a).grey, read_segments(folder + kind + "1.txt"),
        read_image(folder + pair.image_b).grey,
        read_segments(folder + kind + pair.number_b + ".txt"), {});
    EXPECT_TRUE(found.outcome) << pair.name << ": " << found.outcome.reason;
    std::set<std::pair<int, int>> matches;
    for (const SegmentMatch& match : found.matches) matches.emplace(match.a, match.b);
    const test::SegmentJudgement result = test::judge_segment_matches(
        matches, test::read_segment_groups(folder + kind + "_GroundTruthMatches.txt"));
    std::cout << pair.name << " " << kind << ": " << found.matches.size() << " matches, precision "
              << result.precision << ", recall of groups " << result.recall_groups << ", of pairs "
              << result.recall_pairs << "\n";
    EXPECT_GT(result.precision, 0.8) << pair.name;
    precision.push_back(result.precision);
    recall.push_back(result.recall_groups);
  }
  std::cout << "median precision " << median(precision) << ", recall " << median(recall) << "\n";
  EXPECT_GE(median(precision), 0.95);
  EXPECT_GE(median(recall), 0.6);
}

INSTANTIATE_TEST_SUITE_P(Segments, LineMatching, testing::Values("lsd", "ed"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace line_matching_test
}  // namespace placegraph
