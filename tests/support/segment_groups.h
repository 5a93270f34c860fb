#pragma once
#include <placegraph/io/files/text_file.h>

#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::test {

/// Segments of one edge in either image: each in `a` matches each in `b`.
struct SegmentGroup {
  std::vector<int> a, b;
};

/// "(0,28) (3)" a line.
inline std::vector<SegmentGroup> read_segment_groups(const std::string& path) {
  TextFile file(path);
  std::vector<SegmentGroup> groups;
  for (std::string_view line; file.next_data(line);) {
    SegmentGroup group;
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

struct SegmentJudgement {
  double precision = 0;      ///< share of the matches that people marked too
  double recall_groups = 0;  ///< share of the groups of which a pair was found
  double recall_pairs = 0;   ///< share of all pairs of segments in groups
};

/// Of pairs (index in a, index in b).
inline SegmentJudgement judge_segment_matches(const std::set<std::pair<int, int>>& found,
                                              const std::vector<SegmentGroup>& groups) {
  std::set<std::pair<int, int>> truth;
  int hit = 0, right = 0;
  for (const SegmentGroup& group : groups) {
    bool any = false;
    for (int i : group.a)
      for (int j : group.b) {
        truth.emplace(i, j);
        any |= found.contains({i, j});
      }
    hit += any;
  }
  for (const auto& match : found) right += truth.contains(match);
  const auto share = [](int segment, std::size_t whole) {
    return whole ? segment / static_cast<double>(whole) : 0.0;
  };
  return {share(right, found.size()), share(hit, groups.size()), share(right, truth.size())};
}

}  // namespace placegraph::test
