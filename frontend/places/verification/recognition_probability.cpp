#include <placegraph/frontend/places/verification/recognition_probability.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

double share_agreed(const std::vector<ViewEstimate>& estimates) {
  const auto agreed = std::count_if(estimates.begin(), estimates.end(),
                                    [](const ViewEstimate& estimate) { return estimate.agreed; });
  // Laplace's rule: a few predictions without agreement do not give a probability of zero.
  return (static_cast<double>(agreed) + 1) / (static_cast<double>(estimates.size()) + 2);
}

}  // namespace

std::vector<ViewEvidence> lone_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                        int views) {
  std::vector<ViewEvidence> result;
  for (const auto& list : lists) {
    ViewEvidence& evidence = result.emplace_back();
    if (list.empty()) continue;
    const auto least = std::min_element(
        list.begin(), list.end(),
        [](const PlaceSimilarity& a, const PlaceSimilarity& b) { return a.score < b.score; });
    evidence.forwards.assign(static_cast<std::size_t>(views), least->score);
    for (const PlaceSimilarity& similarity : list)
      evidence.forwards[static_cast<std::size_t>(similarity.view)] = similarity.score;
    evidence.backwards = evidence.forwards;
  }
  return result;
}

std::vector<ViewEvidence> sequence_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                            int views, const SequenceFilterOptions& options) {
  std::vector<ViewEvidence> result(lists.size());
  SequenceFilter forwards(options), backwards(options);
  const auto follow = [&](SequenceFilter& filter, std::size_t i, std::vector<double>& scores) {
    const auto filtered = filter.update(lists[i], 0, views - 1);
    scores.assign(filtered.size(), 0);
    for (const PlaceSimilarity& similarity : filtered)
      scores[static_cast<std::size_t>(similarity.view)] = similarity.score;
  };
  for (std::size_t i = 0; i < lists.size(); ++i) follow(forwards, i, result[i].forwards);
  for (std::size_t i = lists.size(); i-- > 0;) follow(backwards, i, result[i].backwards);
  return result;
}

ViewEstimate view_estimate(const ViewEvidence& evidence, const NearViews& near,
                           const std::function<bool(int)>& allowed) {
  const auto& [forwards, backwards] = evidence;
  std::vector<int> views;
  for (int view = 0; view < static_cast<int>(forwards.size()); ++view)
    if (allowed(view)) views.push_back(view);
  ViewEstimate estimate;
  if (views.empty()) return estimate;
  const auto ahead = [&](int view) { return forwards[static_cast<std::size_t>(view)]; };
  const auto behind = [&](int view) { return backwards[static_cast<std::size_t>(view)]; };
  const auto both = [&](int view) { return 0.5 * (ahead(view) + behind(view)); };
  const auto best_by = [&](const auto& score) {
    return *std::max_element(views.begin(), views.end(),
                             [&](int a, int b) { return score(a) < score(b); });
  };
  estimate.view = best_by(both);
  double second = both(estimate.view), least = second;
  bool alone = true;
  for (const int view : views) {
    least = std::min(least, both(view));
    if (near(estimate.view, view)) continue;
    second = alone ? both(view) : std::max(second, both(view));
    alone = false;
  }
  estimate.margin = both(estimate.view) - (alone ? least : second);
  estimate.agreed = near(estimate.view, best_by(ahead)) && near(estimate.view, best_by(behind));
  return estimate;
}

RecognitionProbability::RecognitionProbability(const std::vector<ViewEstimate>& wrong,
                                               const std::vector<ViewEstimate>& right) {
  require(!wrong.empty() && !right.empty(),
          "RecognitionProbability: no predictions to calibrate with");
  // Keeps the quotient finite. Chosen.
  constexpr double kLeast = 1e-6;
  for (const ViewEstimate& estimate : wrong)
    mean_wrong_ += estimate.margin / static_cast<double>(wrong.size());
  mean_wrong_ = std::max(kLeast, mean_wrong_);
  std::vector<double> margins;
  for (const ViewEstimate& estimate : right) margins.push_back(estimate.margin);
  const auto nine_tenths = margins.begin() + static_cast<std::ptrdiff_t>(margins.size() * 9 / 10);
  std::nth_element(margins.begin(), nine_tenths, margins.end());
  largest_right_ = std::max(*nine_tenths, mean_wrong_);
  agreed_wrong_ = share_agreed(wrong);
  agreed_right_ = share_agreed(right);
}

double RecognitionProbability::log_odds(const ViewEstimate& estimate) const {
  const double agreement =
      estimate.agreed ? agreed_right_ / agreed_wrong_ : (1 - agreed_right_) / (1 - agreed_wrong_);
  return std::log(agreement) + estimate.margin / mean_wrong_ -
         std::log(largest_right_ / mean_wrong_);
}

std::vector<double> RecognitionProbability::probabilities(
    const std::vector<ViewEstimate>& estimates, const NearViews& near, int reach) const {
  const int count = static_cast<int>(estimates.size());
  const auto view = [&](int i) { return estimates[static_cast<std::size_t>(i)].view; };
  const auto follows = [&](int a, int b) {
    return view(a) >= 0 && view(b) >= 0 && near(view(a), view(b));
  };
  std::vector<double> result;
  for (int i = 0; i < count; ++i) {
    int first = i, last = i;
    while (first > 0 && i - first < reach && follows(first - 1, first)) --first;
    while (last + 1 < count && last - i < reach && follows(last, last + 1)) ++last;
    double sum = 0;
    for (int k = first; k <= last; ++k) sum += log_odds(estimates[static_cast<std::size_t>(k)]);
    result.push_back(view(i) < 0 ? 0 : 1 / (1 + std::exp(-sum / (last - first + 1))));
  }
  return result;
}

}  // namespace placegraph
