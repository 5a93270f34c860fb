#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr std::array kPaces = {1.0, -1.0, 0.5, -0.5, 2.0, -2.0};

}  // namespace

void SequenceFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SequenceFilterOptions& o) {
  field("memory", o.memory, "weight of the past against the present image", {0, 0.999});
  field("pace_penalty", o.pace_penalty, "per squared view a step is off the pace", {0, 1e3});
  field("max_step", o.max_step, "views between the answers of two images", {1, 100});
}

SequenceFilter::SequenceFilter(const SequenceFilterOptions& options) : options_(options) {
  options_.check();
}

std::vector<double> SequenceFilter::predict(const State& state, int first, int last) const {
  const auto count = static_cast<int>(state.score.size());
  // A path may begin at a view that was none before: as likely as the middle one.
  const double begin = median_of(state.score);
  std::vector<double> best(static_cast<std::size_t>(last - first + 1),
                           -std::numeric_limits<double>::infinity());
  const int direction = state.pace < 0 ? -1 : 1;
  for (int step = 0; step <= options_.max_step; ++step) {
    const double off = step - std::abs(state.pace);
    const double penalty = options_.pace_penalty * off * off;
    for (int view = first; view <= last; ++view) {
      const int from = view - direction * step - first_;
      const double before =
          from >= 0 && from < count ? state.score[static_cast<std::size_t>(from)] : begin;
      double& score = best[static_cast<std::size_t>(view - first)];
      score = std::max(score, before - penalty);
    }
  }
  return best;
}

std::vector<PlaceLikeness> SequenceFilter::update(const std::vector<PlaceLikeness>& list, int first,
                                                  int last) {
  if (list.empty()) {
    restart();
    return {};
  }
  double least = std::numeric_limits<double>::infinity();
  for (const PlaceLikeness& likeness : list) {
    require(likeness.view >= first && likeness.view <= last,
            "SequenceFilter: a view outside the range");
    least = std::min(least, likeness.score);
  }
  std::vector<double> row(static_cast<std::size_t>(last - first + 1), least);
  for (const PlaceLikeness& likeness : list)
    row[static_cast<std::size_t>(likeness.view - first)] = likeness.score;

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
  std::vector<PlaceLikeness> result;
  for (int view = first; view <= last; ++view) {
    double best = -std::numeric_limits<double>::infinity();
    for (const State& state : states_)
      best = std::max(best, state.score[static_cast<std::size_t>(view - first)]);
    result.push_back({view, best / weight_});
  }
  std::stable_sort(
      result.begin(), result.end(),
      [](const PlaceLikeness& a, const PlaceLikeness& b) { return a.score > b.score; });
  return result;
}

}  // namespace placegraph
