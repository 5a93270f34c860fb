#include <placegraph/frontend/vanishing/vanishing_search.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Cost of a line's share while its direction is only a proposal [nats].
constexpr double kSearchCost = 2.3;

}  // namespace

VanishingSearch::VanishingSearch(const VanishingEvidence& evidence, int samples, Random& random)
    : evidence_(evidence), samples_(samples), random_(random) {
  draw(samples, {});
}

/// Draws pairs with a probability that grows with the lines' lengths, among lines without a
/// direction.
void VanishingSearch::draw(int count, const std::vector<int>& of) {
  const std::size_t n = static_cast<std::size_t>(evidence_.size());
  std::vector<double> sum(n);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool taken = i < of.size() && of[i] >= 0;
    if (!taken) total += evidence_.length(static_cast<int>(i));
    sum[i] = total;
  }
  if (!(total > 0)) return;
  const auto one = [&] {
    const auto where = std::upper_bound(sum.begin(), sum.end(), random_.uniform(0, total));
    return std::min(static_cast<int>(where - sum.begin()), static_cast<int>(n) - 1);
  };
  for (int k = 0; k < count; ++k) {
    const int a = one(), b = one();
    const Eigen::Vector3d v = evidence_.normal(a).cross(evidence_.normal(b));
    constexpr double kSamePlane = 0.005;  // two collinear lines determine no direction
    if (v.norm() > kSamePlane) directions_.push_back(v.normalized());
  }
  gains_.conservativeResize(evidence_.size(), size());
  for (; scored_ < size(); ++scored_) score(scored_);
}

void VanishingSearch::score(Eigen::Index proposal) {
  evidence_.quick_gains(directions_[static_cast<std::size_t>(proposal)], kSearchCost,
                        gains_.col(proposal));
}

void VanishingSearch::refresh() {
  for (Eigen::Index h = 0; h < size(); ++h) score(h);
}

/// Gains of the lines with the model's directions, by quick_gains.
Eigen::ArrayXf VanishingSearch::present_gains(const VanishingModel& model) const {
  Eigen::ArrayXf present = Eigen::ArrayXf::Zero(evidence_.size()), gains = present;
  for (const FittedDirection& direction : model.directions()) {
    evidence_.quick_gains(direction.v, kSearchCost, gains);
    present = present.max(gains);
  }
  return present;
}

/// The `count` proposals that add most to the present gains, best first, no two close to each
/// other.
std::vector<Eigen::Vector3d> VanishingSearch::best(const Eigen::ArrayXf& present, int count) const {
  std::vector<float> scores(directions_.size());
  for (Eigen::Index h = 0; h < size(); ++h)
    scores[static_cast<std::size_t>(h)] = (gains_.col(h) - present).max(0.0F).sum();
  std::vector<Eigen::Vector3d> found;
  for (int k = 0; k < count && !scores.empty(); ++k) {
    const auto top = std::max_element(scores.begin(), scores.end());
    if (!(*top > 0)) break;
    const Eigen::Vector3d v = directions_[static_cast<std::size_t>(top - scores.begin())];
    found.push_back(v);
    constexpr double kClose = 0.996;  // 5 degrees
    for (std::size_t h = 0; h < scores.size(); ++h)
      if (std::abs(directions_[h].dot(v)) > kClose) scores[h] = 0;
  }
  return found;
}

void VanishingSearch::grow(VanishingModel& model, int max_directions) {
  // Directions that are tried: the cost. Chosen.
  constexpr int kTrials = 3;
  bool fresh = false;
  while (model.size() < max_directions) {
    std::optional<VanishingModel> next;
    for (const Eigen::Vector3d& v : best(present_gains(model), kTrials)) {
      std::optional<VanishingModel> trial = model.with(v);
      if (trial && trial->cost() < (next ? next->cost() : model.cost())) next = std::move(trial);
    }
    if (next) {
      model = *std::move(next);
      model.polish(1);
      fresh = false;
    } else if (!fresh) {
      draw(samples_ / 2, model.of());
      fresh = true;
    } else {
      return;
    }
  }
}

}  // namespace placegraph
