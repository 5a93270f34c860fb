#include <placegraph/frontend/features/detector.h>
#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/flow/matched_displacements.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <utility>

namespace placegraph {
namespace {

struct Displacement {
  Eigen::Vector2f from, by;
};

/// Median, per coordinate, of the displacements that begin nearest to `px`.
Eigen::Vector2f median_nearby(const std::vector<Displacement>& all, const Eigen::Vector2f& px) {
  // Displacements with a median that two outliers do not affect. Chosen.
  constexpr std::size_t kNearest = 5;
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t i = 0; i < all.size(); ++i)
    order.emplace_back((all[i].from - px).squaredNorm(), i);
  std::nth_element(order.begin(), order.begin() + (kNearest - 1), order.end());
  std::vector<double> u, v;
  for (std::size_t k = 0; k < kNearest; ++k) {
    u.push_back(all[order[k].second].by.x());
    v.push_back(all[order[k].second].by.y());
  }
  return Eigen::Vector2d(median_of(u), median_of(v)).cast<float>();
}

}  // namespace

bool track_near_matches(PointTracker& tracker, const Image& image) {
  // Matches with displacements. Chosen.
  constexpr std::size_t kLeastMatches = 20;
  if (tracker.image().empty() || tracker.tracks().empty()) return false;
  const std::vector<Feature> before = detect_features(tracker.image(), DetectorOptions());
  const std::vector<Feature> now = detect_features(image, DetectorOptions());
  std::vector<Displacement> displacements;
  for (const FeatureMatch& match : match_features(before, now, MatcherOptions()))
    displacements.push_back({before[match.a].px, now[match.b].px - before[match.a].px});
  if (displacements.size() < kLeastMatches) return false;
  std::vector<Eigen::Vector2f> displaced;
  for (const PointTrack& track : tracker.tracks())
    displaced.emplace_back(track.px + median_nearby(displacements, track.px));
  tracker.track(image, displaced, PointTracker::Search::kNear);
  return true;
}

}  // namespace placegraph
