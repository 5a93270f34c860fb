#include <placegraph/backend/robust/loop_clusters.h>
#include <placegraph/graph/core/disjoint_sets.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

namespace placegraph {
namespace {

/// Mixture of three kinds of rings; the shares add up to one.
struct Mixture {
  double scale = 1, wide_scale = 1;
  double share = 0.5, wide_share = 0.25;
  double log_likelihood = -std::numeric_limits<double>::infinity();
};
/// Minimum ratio of the noise of confused rings to that of inaccurate ones, in standard deviations.
constexpr double kWide = 100;
/// Minimum number of rings that close at a scale, so that a pair of equal loops does not suffice.
constexpr double kLeast = 10;
/// Minimum number of single loops that determine the scale with the odometry if rings of two do
/// not.
constexpr std::size_t kFewestLoops = 4;
/// Misclosures below this share of the map are caused by rounding and the solver's tolerance.
constexpr double kLeastShare = 1e-7;

struct Posterior {
  double closes, confused;
  double log_density;
};

/// The common terms of all rings in the posterior of a mixture.
class RingPosterior {
 public:
  RingPosterior(const Mixture& m, int dof, double log_volume)
      : scale_(m.scale),
        wide_scale_(m.wide_scale),
        closes_(std::log(m.share) - 0.5 * dof * std::log(2 * std::numbers::pi * m.scale)),
        confused_(std::log(m.wide_share) -
                  0.5 * dof * std::log(2 * std::numbers::pi * m.wide_scale)),
        anywhere_(std::log(1 - m.share - m.wide_share) - log_volume) {}

  Posterior operator()(const RingMisclosure& ring) const {
    const double closes = closes_ - 0.5 * (ring.chi2 / scale_ + ring.log_determinant);
    const double confused = confused_ - 0.5 * (ring.chi2 / wide_scale_ + ring.log_determinant);
    const double most = std::max({closes, confused, anywhere_});
    const double p_closes = std::exp(closes - most), p_confused = std::exp(confused - most);
    const double sum = p_closes + p_confused + std::exp(anywhere_ - most);
    return {p_closes / sum, p_confused / sum, most + std::log(sum)};
  }

 private:
  double scale_, wide_scale_;
  double closes_, confused_, anywhere_;  ///< log(share * density at misclosure zero)
};

/// The scale of the noise at which a typical misclosure is kLeastShare of the map.
/// It is the geometric mean over the directions, and is proportional to the information.
double least_scale(const std::vector<RingMisclosure>& rings, int dof, double log_volume) {
  std::vector<double> log_determinants;
  for (const RingMisclosure& ring : rings) log_determinants.push_back(ring.log_determinant);
  const auto middle =
      log_determinants.begin() + static_cast<std::ptrdiff_t>(log_determinants.size() / 2);
  std::nth_element(log_determinants.begin(), middle, log_determinants.end());
  return std::exp((2 * log_volume - *middle) / dof + 2 * std::log(kLeastShare));
}

/// Initial scales, each ten times the previous one, over the range of the misclosures.
std::vector<double> scales_to_try(const std::vector<RingMisclosure>& rings, int dof, double least) {
  std::vector<double> chi2;
  for (const RingMisclosure& ring : rings) chi2.push_back(ring.chi2 / dof);
  std::sort(chi2.begin(), chi2.end());
  const auto quantile = [&](double q) {
    return chi2[static_cast<std::size_t>(q * static_cast<double>(chi2.size() - 1))];
  };
  constexpr double kLow = 0.02, kHigh = 0.9;  // quantiles, because the extremes are not informative
  std::vector<double> scales{std::max(0.1 * quantile(kLow), least)};
  while (10 * scales.back() < quantile(kHigh)) scales.push_back(10 * scales.back());
  return scales;
}

Mixture fit(const std::vector<RingMisclosure>& rings, int dof, double log_volume, Mixture mixture,
            double least, int iterations) {
  const auto n = static_cast<double>(rings.size());
  for (int i = 0; i < iterations; ++i) {
    double closing = 0, confused = 0, chi2_closing = 0, chi2_confused = 0, log_likelihood = 0;
    const RingPosterior posterior(mixture, dof, log_volume);
    for (const RingMisclosure& ring : rings) {
      const Posterior p = posterior(ring);
      closing += p.closes;
      confused += p.confused;
      chi2_closing += p.closes * ring.chi2;
      chi2_confused += p.confused * ring.chi2;
      log_likelihood += p.log_density;
    }
    const double before = mixture.log_likelihood;
    mixture.log_likelihood = log_likelihood;
    if (closing < std::min(kLeast, 0.5 * n)) return {};  // too few rings to estimate a scale
    mixture.scale = std::max(chi2_closing / (dof * closing), least);
    mixture.wide_scale =
        std::max(confused > 1 ? chi2_confused / (dof * confused) : 0, kWide * mixture.scale);
    // One additional ring of each kind keeps all shares positive.
    mixture.share = (closing + 1) / (n + 3);
    mixture.wide_share = (confused + 1) / (n + 3);
    if (std::abs(log_likelihood - before) < 1e-7 * n) break;
  }
  return mixture;
}

/// The volume that the poses of `chain` span in the tangent space of Group.
template <class Group>
double tangent_volume(const PackedGraph<Group>& graph, const OdometryChain<Group>& chain) {
  const auto n = static_cast<int>(graph.poses.size());
  typename Group::Point low = chain.pose(0).translation(), high = low;
  for (int i = 0; i < n; ++i) {
    low = low.cwiseMin(chain.pose(i).translation());
    high = high.cwiseMax(chain.pose(i).translation());
  }
  // A misclosure may be as long as the map in either direction. The extent of a map is at least a
  // tenth of its length in every direction (for planar paths in 3D).
  const typename Group::Point extent =
      2 * (high - low).cwiseMax(0.1 * (high - low).norm()).cwiseMax(1e-9);
  const double rotations =
      Group::kDof == 3 ? 2 * std::numbers::pi : 8 * std::numbers::pi * std::numbers::pi;
  constexpr double kLogScales = 2;  // a factor of e in either direction
  return extent.prod() * rotations * (Group::kDof == 7 ? kLogScales : 1);
}

template <class Group>
std::vector<std::vector<int>> clusters_of(const std::vector<LoopOnChain<Group>>& loops,
                                          const std::vector<LoopPair>& pairs,
                                          const std::vector<double>& probability, double least) {
  DisjointSets sets(loops.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (probability[k] > least) sets.join(pairs[k].a, pairs[k].b);
  std::vector<std::vector<int>> clusters(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i)
    clusters[sets.root(static_cast<int>(i))].push_back(loops[i].edge);
  std::erase_if(clusters, [](const auto& cluster) { return cluster.empty(); });
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return clusters;
}

}  // namespace

namespace {

/// The likeliest mixture from several initial scales; empty if too few rings close.
std::optional<Mixture> likeliest_mixture(const std::vector<RingMisclosure>& rings, int dof,
                                         double log_volume) {
  // A few rings select the initial scale, more rings determine the parameters.
  constexpr std::size_t kFew = 500, kSample = 4000;
  // Iterations at most. Chosen.
  constexpr int kFewIterations = 20, kIterations = 60;
  const auto sample = [&](std::size_t size) {
    std::vector<RingMisclosure> some;
    for (std::size_t i = 0; i < rings.size(); i += 1 + rings.size() / size)
      some.push_back(rings[i]);
    return some;
  };
  if (rings.empty()) return std::nullopt;
  const std::vector<RingMisclosure> few = sample(kFew);
  Mixture best;
  const double least = least_scale(few, dof, log_volume);
  for (const double scale : scales_to_try(few, dof, least)) {
    Mixture start;
    start.scale = scale;
    start.wide_scale = kWide * kWide * scale;
    const Mixture mixture = fit(few, dof, log_volume, start, least, kFewIterations);
    if (mixture.log_likelihood > best.log_likelihood) best = mixture;
  }
  const bool found = best.log_likelihood > -std::numeric_limits<double>::infinity();
  if (found) best = fit(sample(kSample), dof, log_volume, best, least, kIterations);
  if (!(best.log_likelihood > -std::numeric_limits<double>::infinity())) return std::nullopt;
  return best;
}

/// The rings that single loops close with the odometry between their ends, if it is in one run.
template <class Group>
std::vector<RingMisclosure> drift_rings(const std::vector<LoopOnChain<Group>>& loops,
                                        const OdometryChain<Group>& chain) {
  std::vector<RingMisclosure> rings;
  for (const LoopOnChain<Group>& loop : loops)
    if (chain.run(loop.from) == chain.run(loop.to)) rings.push_back(drift_misclosure(loop, chain));
  return rings;
}

}  // namespace

RingMixture fit_rings(const std::vector<LoopPair>& pairs, const std::vector<RingMisclosure>& drift,
                      int dof, double volume) {
  RingMixture result;
  const double log_volume = std::log(volume);
  std::vector<RingMisclosure> rings;
  for (const LoopPair& pair : pairs) rings.push_back(pair.ring);
  std::optional<Mixture> mixture = likeliest_mixture(rings, dof, log_volume);
  if (!mixture && drift.size() >= kFewestLoops) mixture = likeliest_mixture(drift, dof, log_volume);
  result.scale_is_known = mixture.has_value();
  if (!mixture) mixture.emplace();
  result.noise_scale = mixture->scale;
  const RingPosterior posterior(*mixture, dof, log_volume);
  for (const RingMisclosure& ring : rings) result.probability.push_back(posterior(ring).closes);
  return result;
}

namespace {

/// Takes the copies out of the loops, which are sorted by their ends, and returns their edges. A
/// copy is between the same nodes as another loop and differs from it by far less than the noise,
/// which is that of the rings of loops with different ends: their ring says nothing.
template <class Group>
std::vector<int> take_copies(std::vector<LoopOnChain<Group>>& loops,
                             const OdometryChain<Group>& chain, const LoopSupportOptions& options,
                             double volume) {
  constexpr double kOfNoise = 0.01;      // share of the variance
  constexpr std::size_t kCompared = 10;  // loops before it with the same ends
  const auto same_ends = [](const LoopOnChain<Group>& a, const LoopOnChain<Group>& b) {
    return a.from == b.from && a.to == b.to;
  };
  std::vector<LoopOnChain<Group>> firsts;
  std::unique_copy(loops.begin(), loops.end(), std::back_inserter(firsts), same_ends);
  if (firsts.size() == loops.size()) return {};
  const RingMixture rings =
      fit_rings(neighbouring_pairs(firsts, chain, options.reach, options.neighbours),
                drift_rings(firsts, chain), Group::kDof, volume);

  std::vector<LoopOnChain<Group>> kept;
  std::vector<int> copies;
  for (const LoopOnChain<Group>& loop : loops) {
    bool copy = false;
    for (std::size_t k = kept.size(); k > 0 && !copy; --k) {
      const LoopOnChain<Group>& other = kept[k - 1];
      if (!same_ends(other, loop) || kept.size() - k >= kCompared) break;
      const RingMisclosure ring = ring_misclosure(loop, other, chain);
      const double noise = std::max(rings.scale_is_known ? kOfNoise * rings.noise_scale : 0,
                                    least_scale({ring}, Group::kDof, std::log(volume)));
      copy = ring.chi2 <= noise * Group::kDof;
    }
    if (copy)
      copies.push_back(loop.edge);
    else
      kept.push_back(loop);
  }
  loops = std::move(kept);
  return copies;
}

}  // namespace

std::size_t LoopSupport::loops() const {
  std::size_t count = 0;
  for (const auto& cluster : clusters) count += cluster.size();
  return count;
}

template <class Group>
LoopSupport support_loops(const PackedGraph<Group>& graph, const OdometryChain<Group>& chain,
                          const LoopSupportOptions& options) {
  options.check();
  LoopSupport support;
  if (graph.poses.empty()) return support;
  auto loops = loops_on_chain(graph, chain);
  std::vector<std::vector<int>> steps;  // edges that repeat one step of the chain
  std::erase_if(loops, [&](const LoopOnChain<Group>& loop) {
    if (!chain.repeats_step(loop.from, loop.to)) return false;
    steps.push_back({loop.edge});
    return true;
  });
  const double volume = tangent_volume(graph, chain);
  const std::vector<int> copies = take_copies(loops, chain, options, volume);
  const auto pairs = neighbouring_pairs(loops, chain, options.reach, options.neighbours);
  const RingMixture rings = fit_rings(pairs, drift_rings(loops, chain), Group::kDof, volume);
  support.noise_scale = rings.noise_scale;
  support.scale_is_known = rings.scale_is_known;
  support.clusters = clusters_of(loops, pairs, rings.probability, options.least_probability);
  for (const auto& cluster : support.clusters) support.alone += cluster.size() == 1;
  for (const int edge : copies) support.clusters.push_back({edge});
  support.clusters.insert(support.clusters.end(), steps.begin(), steps.end());
  return support;
}

template LoopSupport support_loops(const PackedGraph<SE2>&, const OdometryChain<SE2>&,
                                   const LoopSupportOptions&);
template LoopSupport support_loops(const PackedGraph<SE3>&, const OdometryChain<SE3>&,
                                   const LoopSupportOptions&);
template LoopSupport support_loops(const PackedGraph<Sim3>&, const OdometryChain<Sim3>&,
                                   const LoopSupportOptions&);

}  // namespace placegraph
