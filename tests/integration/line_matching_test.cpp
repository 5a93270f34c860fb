// Segments of real pairs of views matched and held against the groups that people marked.
#include <gtest/gtest.h>
#include <placegraph/frontend/lines/segment_matcher.h>
#include <placegraph/io/image_file.h>
#include <placegraph/io/segment_file.h>
#include <placegraph/io/text_file.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>

#include "tests/support/data.h"

namespace placegraph {
namespace {

/// Segments of one edge in either image: each in `a` matches each in `b`.
struct Group {
  std::vector<int> a, b;
};

/// "(0,28) (3)" a line.
std::vector<Group> read_groups(const std::string& path) {
  TextFile file(path);
  std::vector<Group> groups;
  for (std::string_view line; file.next_data(line);) {
    Group group;
    std::vector<int>* side = &group.a;
    std::istringstream text{std::string(line)};
    for (char c = 0; text >> c;) {
      if (c == ')') side = &group.b;
      if (c != '(' && c != ',') continue;
      int index = 0;
      if (text >> index) side->push_back(index);
    }
    groups.push_back(group);
  }
  return groups;
}

struct Judgement {
  double precision = 0;      ///< share of the matches that people marked too
  double recall_groups = 0;  ///< share of the groups of which a pair was found
  double recall_pairs = 0;   ///< share of all pairs of segments in groups
};

Judgement judge(const std::vector<SegmentMatch>& matches, const std::vector<Group>& groups) {
  std::set<std::pair<int, int>> found, truth;
  for (const SegmentMatch& match : matches) found.emplace(match.a, match.b);
  int hit = 0, right = 0;
  for (const Group& group : groups) {
    bool any = false;
    for (int i : group.a)
      for (int j : group.b) {
        truth.emplace(i, j);
        any |= found.contains({i, j});
      }
    hit += any;
  }
  for (const auto& match : found) right += truth.contains(match);
  const auto share = [](int part, std::size_t whole) {
    return whole ? part / static_cast<double>(whole) : 0.0;
  };
  return {share(right, found.size()), share(hit, groups.size()), share(right, truth.size())};
}

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
    const Judgement result =
        judge(found.matches, read_groups(folder + kind + "_GroundTruthMatches.txt"));
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

}  // namespace
}  // namespace placegraph
