#include <placegraph/eval/scene/plane_check.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <map>
#include <set>

namespace placegraph {
namespace {

struct Regions {
  std::map<int, int> truth, found;  ///< points of each label
  /// Number of common points by true label, then found label.
  std::map<int, std::map<int, int>> common;
};

Regions count_regions(const std::vector<int>& truth, const std::vector<int>& found) {
  Regions regions;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] > 0) ++regions.truth[truth[i]];
    if (found[i] > 0) ++regions.found[found[i]];
    if (truth[i] > 0 && found[i] > 0) ++regions.common[truth[i]][found[i]];
  }
  return regions;
}

}  // namespace

double PlaneCheck::correct_share() const {
  return truth > 0 ? static_cast<double>(correct) / truth : 0;
}

double PlaneCheck::over_segmented_per_plane() const {
  return truth > 0 ? static_cast<double>(over_segmented) / truth : 0;
}

PlaneCheck check_planes(const std::vector<int>& truth, const std::vector<int>& found,
                        const PlaneCheckOptions& options) {
  require(truth.size() == found.size(), "planes: true and found labels of " +
                                            std::to_string(truth.size()) + " and " +
                                            std::to_string(found.size()) + " points");
  require(options.overlap > 0.5 && options.overlap <= 1,
          "planes: overlap: " + std::to_string(options.overlap) + " is not above 0.5 and up to 1");
  const Regions regions = count_regions(truth, found);
  PlaneCheck check;
  std::set<int> explained;                                 // found labels with a match
  std::map<int, std::vector<std::pair<int, int>>> within;  // true regions in each found region
  for (const auto& [label, points] : regions.truth) {
    PlaneCheckMatch match{label, 0, points, 0};
    int together = 0;
    std::vector<int> pieces;
    const auto row = regions.common.find(label);
    if (row != regions.common.end())
      for (const auto& [other, common] : row->second) {
        const bool holds = common >= options.overlap * points;
        const bool inside = common >= options.overlap * regions.found.at(other);
        if (holds && inside) match.found = other, match.common = common;
        if (inside) pieces.push_back(other), together += common;
        if (holds) within[other].emplace_back(label, common);
      }
    const bool counts = points >= options.min_points;
    const bool over = pieces.size() >= 2 && together >= options.overlap * points;
    explained.insert(pieces.begin(), pieces.end());
    if (match.found > 0) explained.insert(match.found);
    if (!counts) continue;
    ++check.truth;
    check.correct += match.found > 0;
    check.over_segmented += over && match.found == 0;
    check.extra_pieces += std::max<int>(0, static_cast<int>(pieces.size()) - 1);
    check.missed += match.found == 0 && !over;
    check.matches.push_back(match);
  }
  for (const auto& [label, held] : within) {
    int together = 0;
    for (const auto& [region, common] : held) together += common;
    if (held.size() < 2 || together < options.overlap * regions.found.at(label)) continue;
    ++check.under_segmented;
    explained.insert(label);
    for (const auto& [region, common] : held)
      check.missed -= regions.truth.at(region) >= options.min_points &&
                      std::none_of(check.matches.begin(), check.matches.end(),
                                   [&, r = region](const PlaneCheckMatch& match) {
                                     return match.truth == r && match.found > 0;
                                   });
  }
  for (const auto& [label, points] : regions.found)
    check.noise += points >= options.min_points && !explained.contains(label);
  return check;
}

}  // namespace placegraph
