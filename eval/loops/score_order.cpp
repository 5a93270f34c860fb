#include <fmt/format.h>
#include <placegraph/eval/loops/score_order.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace placegraph {
namespace {

/// Lists of candidates as they were given.
struct GivenOrder {
  int ascending = 0, lists = 0;  ///< lists of two different scores or more
  double log_chance = 0;         ///< logarithm of the chance that unordered lists ascend so often
};

GivenOrder order_of(const std::vector<LoopPrediction>& predictions) {
  std::map<FrameId, std::vector<double>> lists;
  for (const LoopPrediction& p : predictions) lists[p.query].push_back(p.score);
  GivenOrder order;
  for (const auto& [query, scores] : lists) {
    if (scores.size() < 2 || scores.front() == scores.back()) continue;
    ++order.lists;
    if (!std::is_sorted(scores.begin(), scores.end())) continue;
    ++order.ascending;
    order.log_chance -= std::lgamma(static_cast<double>(scores.size()) + 1);  // one order of n!
  }
  return order;
}

/// How right and wrong candidates differ in their scores.
struct RankOrder {
  double share = 0.5;    ///< of the pairs right and wrong in which the right one has more
  double deviations = 0;  ///< of that share from a half, in its standard deviations
};

/// Nothing without right ones or without wrong ones.
std::optional<RankOrder> rank_order_of(std::vector<ScoredPrediction> judged) {
  std::sort(judged.begin(), judged.end(), [](const ScoredPrediction& a, const ScoredPrediction& b) {
    return a.score < b.score;
  });
  double right = 0, rank_sum = 0;
  for (std::size_t first = 0; first < judged.size();) {
    std::size_t last = first;
    while (last < judged.size() && judged[last].score == judged[first].score) ++last;
    const double rank = (static_cast<double>(first + last) + 1) / 2;  // mean rank of equal scores
    for (; first < last; ++first)
      if (judged[first].correct) ++right, rank_sum += rank;
  }
  const auto all = static_cast<double>(judged.size());
  const double wrong = all - right;
  if (right == 0 || wrong == 0) return std::nullopt;
  RankOrder order;
  order.share = (rank_sum - right * (right + 1) / 2) / (right * wrong);
  order.deviations = (order.share - 0.5) / std::sqrt((all + 1) / (12 * right * wrong));
  return order;
}

}  // namespace

std::string reversed_scores(const std::vector<LoopPrediction>& predictions,
                            const std::vector<ScoredPrediction>& judged) {
  // A list in twenty may have scores that are equal but for rounding. Chosen.
  constexpr double kNearlyAll = 0.95;
  // Less often than in a million recognizers whose scores say nothing.
  constexpr double kLogChance = -13.8;
  // Neighbouring queries are not independent: as if one in four were, 2.5 deviations are left.
  constexpr double kDeviations = -5;
  // A recognizer whose scores say little about right and wrong is not reversed. Chosen.
  constexpr double kReversed = 0.3;
  const GivenOrder given = order_of(predictions);
  const auto rank = rank_order_of(judged);
  if (given.ascending >= kNearlyAll * given.lists && given.log_chance < kLogChance &&
      (!rank || rank->share < 0.5))
    return fmt::format("the scores of {} of {} queries ascend, the smallest first", given.ascending,
                       given.lists);
  if (rank && rank->share < kReversed && rank->deviations < kDeviations)
    return fmt::format("right candidates have smaller scores than wrong ones in {:.0f} % of the pairs",
                       100 * (1 - rank->share));
  return {};
}

}  // namespace placegraph
