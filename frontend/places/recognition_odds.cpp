#include <placegraph/frontend/places/recognition_odds.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {

StandingOut standing_out(const std::vector<PlaceLikeness>& list, const NearViews& near) {
  StandingOut result;
  if (list.empty()) return result;
  const auto by_score = [](const PlaceLikeness& a, const PlaceLikeness& b) {
    return a.score < b.score;
  };
  const PlaceLikeness best = *std::max_element(list.begin(), list.end(), by_score);
  double second = std::min_element(list.begin(), list.end(), by_score)->score;
  for (const PlaceLikeness& other : list)
    if (other.score > second && !near(best.view, other.view)) second = other.score;
  return {best.view, best.score - second};
}

std::vector<std::vector<PlaceLikeness>> join_sequence(
    const std::vector<std::vector<PlaceLikeness>>& lists, int views,
    const SequenceFilterOptions& options) {
  std::vector<std::vector<PlaceLikeness>> joined(lists.size());
  const auto add = [&](SequenceFilter& filter, std::size_t i) {
    auto& sum = joined[i];
    if (sum.empty())
      for (int view = 0; view < views; ++view) sum.push_back({view, 0});
    if (lists[i].empty()) sum.clear();
    for (const PlaceLikeness& likeness : filter.update(lists[i], 0, views - 1))
      sum[static_cast<std::size_t>(likeness.view)].score += 0.5 * likeness.score;
  };
  SequenceFilter forwards(options), backwards(options);
  for (std::size_t i = 0; i < lists.size(); ++i) add(forwards, i);
  for (std::size_t i = lists.size(); i-- > 0;) add(backwards, i);
  return joined;
}

RecognitionOdds::RecognitionOdds(const std::vector<double>& wrong, std::vector<double> right) {
  require(!wrong.empty() && !right.empty(), "RecognitionOdds: no margins to learn from");
  constexpr double kLeast = 1e-6;
  mean_wrong_ = std::max(
      kLeast, std::accumulate(wrong.begin(), wrong.end(), 0.0) / static_cast<double>(wrong.size()));
  // But for the tenth that stand out most.
  const auto nine_tenths = right.begin() + static_cast<std::ptrdiff_t>(right.size() * 9 / 10);
  std::nth_element(right.begin(), nine_tenths, right.end());
  largest_right_ = std::max(*nine_tenths, mean_wrong_);
}

double RecognitionOdds::probability(double margin) const {
  const double wrong = std::exp(-std::max(0.0, margin) / mean_wrong_) / mean_wrong_;
  return 1 / (1 + wrong * largest_right_);
}

}  // namespace placegraph
