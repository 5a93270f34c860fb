#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/function_clones.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

// Pace of a query over that of the map, either way. Chosen.
constexpr std::array kPaces = {1.0, -1.0, 0.5, -0.5, 2.0, -2.0};

// best[i] = max(best[i], before[i] - penalty)
PLACEGRAPH_CLONES
void raise(double* best, const double* before, std::size_t count, double penalty) {
  for (std::size_t i = 0; i < count; ++i) best[i] = std::max(best[i], before[i] - penalty);
}

// Median of the scores; of many scores only a sample is used, as the map may be large.
double middle_of(const std::vector<double>& scores) {
  // Scores of a sample: the cost. Chosen.
  constexpr std::size_t kMost = 2000;
  const std::size_t stride = 1 + (scores.size() - 1) / kMost;
  if (stride == 1) return median_of(scores);
  std::vector<double> some;
  for (std::size_t i = 0; i < scores.size(); i += stride) some.push_back(scores[i]);
  return median_of(std::move(some));
}

}  // namespace

SequenceFilter::SequenceFilter(const SequenceFilterOptions& options) : options_(options) {
  options_.check();
}

std::vector<double> SequenceFilter::predict(const State& state, int first, int last) const {
  const auto count = static_cast<int>(state.score.size());
  // A path may also begin at any view, with the score of the median view.
  const double begin = middle_of(state.score);
  const int size = last - first + 1;
  std::vector<double> best(static_cast<std::size_t>(size),
                           -std::numeric_limits<double>::infinity());
  const int direction = state.pace < 0 ? -1 : 1;
  for (int step = 0; step <= options_.max_step; ++step) {
    const double off = step - std::abs(state.pace);
    const double penalty = options_.pace_penalty * off * off;
    // Views of first..last that a view of the previous range leads to; at the others a path begins.
    const int shift = direction * step + first_ - first;
    const int known = std::clamp(shift, 0, size), end = std::clamp(count + shift, known, size);
    if (known < end)
      raise(&best[static_cast<std::size_t>(known)],
            &state.score[static_cast<std::size_t>(known - shift)],
            static_cast<std::size_t>(end - known), penalty);
    const auto begin_at = [&](double& score) { score = std::max(score, begin - penalty); };
    std::for_each(best.begin(), best.begin() + known, begin_at);
    std::for_each(best.begin() + end, best.end(), begin_at);
  }
  return best;
}

std::vector<PlaceSimilarity> SequenceFilter::update(const std::vector<PlaceSimilarity>& list,
                                                    int first, int last) {
  if (list.empty()) {
    restart();
    return {};
  }
  double least = std::numeric_limits<double>::infinity();
  for (const PlaceSimilarity& similarity : list) {
    require(similarity.view >= first && similarity.view <= last,
            "SequenceFilter: a view outside the range");
    least = std::min(least, similarity.score);
  }
  std::vector<double> row(static_cast<std::size_t>(last - first + 1), least);
  for (const PlaceSimilarity& similarity : list)
    row[static_cast<std::size_t>(similarity.view - first)] = similarity.score;

  if (states_.empty()) {
    for (const double pace : kPaces) states_.push_back({pace, row});
    weight_ = 1;
  } else {
    for (State& state : states_) {
      std::vector<double> score = predict(state, first, last);
      for (std::size_t i = 0; i < row.size(); ++i) score[i] = row[i] + options_.memory * score[i];
      state.score = std::move(score);
    }
    weight_ = 1 + options_.memory * weight_;
  }
  first_ = first;
  std::vector<PlaceSimilarity> result;
  for (int view = first; view <= last; ++view) {
    double best = -std::numeric_limits<double>::infinity();
    for (const State& state : states_)
      best = std::max(best, state.score[static_cast<std::size_t>(view - first)]);
    result.push_back({view, best / weight_});
  }
  std::stable_sort(
      result.begin(), result.end(),
      [](const PlaceSimilarity& a, const PlaceSimilarity& b) { return a.score > b.score; });
  return result;
}

double SequenceFilter::confidence(const PlaceSimilarity& prediction,
                                  const std::vector<PlaceSimilarity>& list) const {
  double present = std::numeric_limits<double>::infinity();
  for (const PlaceSimilarity& similarity : list) {
    present =
        similarity.view == prediction.view ? similarity.score : std::min(present, similarity.score);
    if (similarity.view == prediction.view) break;
  }
  if (list.empty()) return prediction.score;
  return (prediction.score + options_.present * present) / (1 + options_.present);
}

}  // namespace placegraph
