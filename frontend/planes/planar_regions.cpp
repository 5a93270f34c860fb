#include <placegraph/frontend/planes/label_expansion.h>
#include <placegraph/frontend/planes/planar_regions.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

constexpr double kMaxCost = 1e4;  ///< maximum cost of one match [nats], for impossible ones
/// Initial noise levels, over noise_px: with too much noise large planes absorb small ones, with
/// too little noise large ones are split; the cost decides.
constexpr double kNoiseStarts[] = {0.3, 0.6, 1.2, 2.4};
/// Number of neighbours, beside the sample itself, that must agree with it.
constexpr int kMoreNeighbours = 2;
// Iterations at most. Chosen.
constexpr int kFitIterations = 10;
constexpr int kRounds = 12;  ///< rounds that estimate labels, models and noise in alternation

struct PlaneLabelling {
  std::vector<Matrix3d> models;
  std::vector<int> labels;  // 0: none, k: models[k - 1]
  double share_none = 1;    // share of label 0
  double noise_px = 1;
  bool noise_free = false;  // estimated with the models
  double cost = 0;
};

/// Search for planes: the matches and the constant quantities.
class Search {
 public:
  Search(const PointMatches& matches, const PlanarRegionsOptions& options)
      : matches_(matches), options_(options) {
    Vector2d low = matches.px_cur[0], high = low;
    for (const Vector2d& px : matches.px_cur) {
      low = low.cwiseMin(px);
      high = high.cwiseMax(px);
    }
    log_area_ = std::log(std::max((high - low).prod(), 1.0));
    find_neighbours();
  }

  PlaneLabelling nothing(double noise_px) const;
  /// Finds the best of many local samples and refines it; false if none reduces the cost.
  bool propose(const PlaneLabelling& labelling, Random& random, Matrix3d& H) const;
  /// Estimates labels, models, noise and shares in alternation until the cost is stationary; weak
  /// planes are dropped.
  PlaneLabelling settle(PlaneLabelling labelling, int rounds) const;
  PlaneLabelling merged(PlaneLabelling labelling) const;
  /// Adds planes one by one with fixed noise, then estimates all together with the noise.
  PlaneLabelling search(double noise_px, Random& random) const;
  std::vector<int> members(const PlaneLabelling& labelling, int label) const;

 private:
  void find_neighbours();
  double on_plane_cost(const Matrix3d& H, double noise_px, int i) const;
  double plane_cost(const PlaneLabelling& labelling, int matches) const;
  Eigen::MatrixXd costs(const PlaneLabelling& labelling) const;
  double total(const PlaneLabelling& labelling) const;
  void drop(PlaneLabelling& labelling, int label) const;
  bool relabel(PlaneLabelling& labelling) const;
  void refit(PlaneLabelling& labelling) const;
  /// Whether some of the neighbours among which a sample was drawn are on its plane, too.
  bool agrees(const Matrix3d& H, const PlaneLabelling& labelling,
              const std::vector<int>& near) const;
  double gain(const Matrix3d& H, const PlaneLabelling& labelling, const std::vector<double>& now,
              std::vector<int>* inliers) const;

  const PointMatches& matches_;
  const PlanarRegionsOptions& options_;
  double log_area_ = 0;
  std::vector<std::vector<int>> near_;  // neighbours of each match, nearest first
  std::vector<std::pair<int, int>> neighbours_;
};

void Search::find_neighbours() {
  const int n = matches_.size();
  const int count = std::min(std::max(options_.neighbours, options_.sample_neighbours), n - 1);
  near_.resize(static_cast<std::size_t>(n));
  std::set<std::pair<int, int>> pairs;
  std::vector<std::pair<double, int>> distances;
  for (int i = 0; i < n; ++i) {
    const auto a = static_cast<std::size_t>(i);
    distances.clear();
    for (int j = 0; j < n; ++j) {
      const auto b = static_cast<std::size_t>(j);
      if (j != i)
        distances.emplace_back((matches_.px_ref[a] - matches_.px_ref[b]).squaredNorm() +
                                   (matches_.px_cur[a] - matches_.px_cur[b]).squaredNorm(),
                               j);
    }
    std::partial_sort(distances.begin(), distances.begin() + count, distances.end());
    for (int k = 0; k < count; ++k) {
      near_[a].push_back(distances[static_cast<std::size_t>(k)].second);
      if (k < options_.neighbours)
        pairs.insert(std::minmax(i, distances[static_cast<std::size_t>(k)].second));
    }
  }
  neighbours_.assign(pairs.begin(), pairs.end());
}

double Search::on_plane_cost(const Matrix3d& H, double noise_px, int i) const {
  const auto k = static_cast<std::size_t>(i);
  const TransferError error = transfer_error(H, matches_.px_ref[k], matches_.px_cur[k]);
  const double cost = TransferNoise{noise_px, options_.tail_freedom}.cost(error);
  return std::isfinite(cost) ? std::min(cost, kMaxCost) : kMaxCost;
}

/// Cost of four points of the current view, each with the precision that n matches determine.
double Search::plane_cost(const PlaneLabelling& labelling, int n) const {
  return 4 *
         (log_area_ - std::log(2 * std::numbers::pi * 2 * labelling.noise_px * labelling.noise_px) +
          std::log(std::max(n, 4) / 4.0));
}

Eigen::MatrixXd Search::costs(const PlaneLabelling& labelling) const {
  const int n = matches_.size(), labels = static_cast<int>(labelling.models.size()) + 1;
  Eigen::MatrixXd unary(n, labels);
  for (int l = 0; l < labels; ++l) {
    const double share = -std::log(l == 0 ? labelling.share_none : 1 - labelling.share_none);
    for (int i = 0; i < n; ++i)
      unary(i, l) =
          share + (l == 0 ? log_area_
                          : on_plane_cost(labelling.models[static_cast<std::size_t>(l - 1)],
                                          labelling.noise_px, i));
  }
  return unary;
}

std::vector<int> Search::members(const PlaneLabelling& labelling, int label) const {
  std::vector<int> which;
  for (int i = 0; i < matches_.size(); ++i)
    if (labelling.labels[static_cast<std::size_t>(i)] == label) which.push_back(i);
  return which;
}

void set_share(PlaneLabelling& labelling) {
  // One more of each than counted, so that no probability is zero.
  const auto none = std::count(labelling.labels.begin(), labelling.labels.end(), 0);
  labelling.share_none =
      (1.0 + static_cast<double>(none)) / (2.0 + static_cast<double>(labelling.labels.size()));
}

double Search::total(const PlaneLabelling& labelling) const {
  double cost = label_cost({costs(labelling), neighbours_, options_.smoothness}, labelling.labels);
  for (std::size_t k = 1; k <= labelling.models.size(); ++k)
    cost += plane_cost(labelling, static_cast<int>(members(labelling, static_cast<int>(k)).size()));
  // Inverse gamma prior of the noise, consistent with the estimate in refit.
  const double ratio = options_.noise_px / labelling.noise_px;
  return cost + options_.noise_confidence * (ratio * ratio - 2 * std::log(ratio));
}

PlaneLabelling Search::nothing(double noise_px) const {
  PlaneLabelling labelling;
  labelling.labels.assign(static_cast<std::size_t>(matches_.size()), 0);
  labelling.noise_px = noise_px;
  set_share(labelling);
  labelling.cost = total(labelling);
  return labelling;
}

void Search::drop(PlaneLabelling& labelling, int label) const {
  labelling.models.erase(labelling.models.begin() + label - 1);
  for (int& l : labelling.labels) {
    if (l == label) l = 0;
    if (l > label) --l;
  }
  set_share(labelling);
}

double Search::gain(const Matrix3d& H, const PlaneLabelling& labelling,
                    const std::vector<double>& now, std::vector<int>* inliers) const {
  double sum = 0;
  if (inliers) inliers->clear();
  const double share = -std::log(1 - labelling.share_none);
  for (int i = 0; i < matches_.size(); ++i) {
    const double less =
        now[static_cast<std::size_t>(i)] - on_plane_cost(H, labelling.noise_px, i) - share;
    if (!(less > 0)) continue;
    sum += less;
    if (inliers) inliers->push_back(i);
  }
  return sum;
}

bool Search::agrees(const Matrix3d& H, const PlaneLabelling& labelling,
                    const std::vector<int>& near) const {
  const double none =
      log_area_ - std::log(labelling.share_none) + std::log(1 - labelling.share_none);
  int count = 0;
  for (const int i : near) count += on_plane_cost(H, labelling.noise_px, i) < none;
  return count >= 3 + kMoreNeighbours;
}

bool Search::propose(const PlaneLabelling& labelling, Random& random, Matrix3d& H) const {
  const int n = matches_.size();
  const Eigen::MatrixXd unary = costs(labelling);
  std::vector<double> now(static_cast<std::size_t>(n));
  std::vector<int> seeds;
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    now[k] = unary(i, labelling.labels[k]);
    if (labelling.labels[k] == 0) seeds.push_back(i);
  }
  double best = 0;
  std::vector<int> three, inliers;
  for (int sample = 0; sample < options_.samples; ++sample) {
    // Every second sample begins at a match without a plane.
    const int seed =
        sample % 2 == 0 && !seeds.empty()
            ? seeds[static_cast<std::size_t>(random.index(static_cast<int>(seeds.size())))]
            : random.index(n);
    const std::vector<int>& near = near_[static_cast<std::size_t>(seed)];
    if (near.size() < 3) return false;
    const int reach =
        std::min<int>(static_cast<int>(near.size()), std::max(3, options_.sample_neighbours));
    random.sample(reach, 3, three);
    const auto hypothesis =
        homography_through(matches_, {seed, near[static_cast<std::size_t>(three[0])],
                                      near[static_cast<std::size_t>(three[1])],
                                      near[static_cast<std::size_t>(three[2])]});
    if (!hypothesis) continue;
    Matrix3d model = *hypothesis;
    if (!agrees(model, labelling, near)) continue;
    double score = gain(model, labelling, now, &inliers);
    // Four neighbours determine a plane poorly farther away: refined with its inliers as long as
    // that reduces the cost.
    for (int round = 0; round < 6 && score > 0.4 * best && inliers.size() > 5; ++round) {
      const HomographyFit fit = refine_homography(model, matches_, inliers,
                                                  {labelling.noise_px, options_.tail_freedom}, 3);
      if (!fit.outcome) break;
      std::vector<int> agree;
      const double refined = gain(fit.H_cur_ref, labelling, now, &agree);
      if (!(refined > score)) break;
      score = refined;
      model = fit.H_cur_ref;
      inliers = agree;
    }
    if (score > best) {
      best = score;
      H = model;
    }
  }
  return best > 0;
}

bool Search::relabel(PlaneLabelling& labelling) const {
  std::vector<int> labels = labelling.labels;
  const LabelProblem problem{costs(labelling), neighbours_, options_.smoothness};
  expand_labels(problem, labels);
  const bool changed = labels != labelling.labels;
  labelling.labels = labels;
  for (int k = static_cast<int>(labelling.models.size()); k >= 1; --k)
    if (static_cast<int>(members(labelling, k).size()) < options_.min_matches) drop(labelling, k);
  set_share(labelling);
  return changed;
}

void Search::refit(PlaneLabelling& labelling) const {
  const TransferNoise noise{labelling.noise_px, options_.tail_freedom};
  double squared = 2 * options_.noise_confidence * options_.noise_px * options_.noise_px;
  double freedom = 2 * options_.noise_confidence;
  for (int k = static_cast<int>(labelling.models.size()); k >= 1; --k) {
    Matrix3d& model = labelling.models[static_cast<std::size_t>(k - 1)];
    const std::vector<int> which = members(labelling, k);
    const HomographyFit fit = refine_homography(model, matches_, which, noise, kFitIterations);
    if (!fit.outcome) {
      drop(labelling, k);
      continue;
    }
    model = fit.H_cur_ref;
    for (const int i : which) {
      const auto j = static_cast<std::size_t>(i);
      const TransferError error = transfer_error(model, matches_.px_ref[j], matches_.px_cur[j]);
      squared += noise.weight(error) * error.squared;
    }
    freedom += 2.0 * static_cast<double>(which.size());
  }
  if (labelling.noise_free) labelling.noise_px = std::sqrt(squared / freedom);
}

PlaneLabelling Search::settle(PlaneLabelling labelling, int rounds) const {
  set_share(labelling);
  PlaneLabelling best;
  for (int round = 0; round < rounds; ++round) {
    const bool changed = relabel(labelling);
    refit(labelling);
    labelling.cost = total(labelling);
    if (round == 0 || labelling.cost < best.cost) best = labelling;
    if (!changed) break;
  }
  return best;
}

PlaneLabelling Search::merged(PlaneLabelling labelling) const {
  for (bool lower = true; lower;) {
    lower = false;
    const int planes = static_cast<int>(labelling.models.size());
    for (int a = 1; a <= planes && !lower; ++a)
      for (int b = 0; b <= planes && !lower; ++b) {
        if (b == a) continue;
        PlaneLabelling trial = labelling;
        for (int& l : trial.labels)
          if (l == a) l = b;
        drop(trial, a);
        trial = settle(trial, 2);
        if (!(trial.cost < labelling.cost - 1e-6)) continue;
        labelling = settle(trial, kRounds);
        lower = true;
      }
  }
  return labelling;
}

PlaneLabelling Search::search(double noise_px, Random& random) const {
  PlaneLabelling labelling = nothing(noise_px);
  while (static_cast<int>(labelling.models.size()) < options_.max_planes) {
    PlaneLabelling more = labelling;
    Matrix3d H;
    if (!propose(labelling, random, H)) break;
    more.models.push_back(H);
    more = settle(more, kRounds);
    if (!(more.cost < labelling.cost - 1e-6)) break;
    labelling = std::move(more);
  }
  labelling.noise_free = true;
  return merged(settle(labelling, kRounds));
}

}  // namespace

void PlanarRegionsOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlanarRegionsOptions& o) {
  field("noise_px", o.noise_px, "initial noise of a match, per coordinate and view", {0.01, 100});
  field("noise_confidence", o.noise_confidence,
        "weight of noise_px in the noise estimate, in matches", {0, 1e9});
  field("tail_freedom", o.tail_freedom, "degrees of freedom of the noise, Student t", {1, 1e9});
  field("smoothness", o.smoothness, "cost of two neighbours with different labels [nats]",
        {0, 100});
  field("neighbours", o.neighbours, "number of neighbours of each match, near in both views",
        {0, 100});
  field("samples", o.samples, "number of samples of four matches per search of a plane", {1, 1e7});
  field("sample_neighbours", o.sample_neighbours,
        "number of nearest neighbours of its first match from which a sample is drawn", {3, 1e6});
  field("min_matches", o.min_matches, "minimum number of matches of a plane", {5, 1e6});
  field("max_planes", o.max_planes, "maximum number of planes", {1, 1000});
}

PlanarRegionsResult find_planar_regions(const PointMatches& matches,
                                        const PlanarRegionsOptions& options, Random& random) {
  options.check();
  require(matches.px_ref.size() == matches.px_cur.size(),
          "find_planar_regions: needs as many pixels in both views");
  PlanarRegionsResult result;
  result.labels.assign(matches.px_ref.size(), 0);
  if (matches.size() < options.min_matches) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      std::to_string(matches.size()) + " matches, " +
                                          std::to_string(options.min_matches) + " needed");
    return result;
  }
  const Search search(matches, options);
  PlaneLabelling labelling = search.nothing(options.noise_px);
  const double empty = labelling.cost;
  for (const double factor : kNoiseStarts) {
    PlaneLabelling other = search.search(factor * options.noise_px, random);
    if (other.cost < labelling.cost) labelling = std::move(other);
  }
  result.noise = {labelling.noise_px, options.tail_freedom};
  result.description_length = labelling.cost - empty;
  if (labelling.models.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kNoConsensus, "no plane reduces the cost");
    return result;
  }
  std::vector<std::pair<int, int>> order;
  for (int k = 1; k <= static_cast<int>(labelling.models.size()); ++k)
    order.emplace_back(-static_cast<int>(search.members(labelling, k).size()), k);
  std::sort(order.begin(), order.end());
  for (const auto& [minus_size, k] : order) {
    const std::vector<int> which = search.members(labelling, k);
    const HomographyFit fit = refine_homography(labelling.models[static_cast<std::size_t>(k - 1)],
                                                matches, which, result.noise, kFitIterations);
    result.regions.push_back(
        {fit.H_cur_ref, fit.covariance, static_cast<int>(which.size()), fit.cost});
    for (const int i : which)
      result.labels[static_cast<std::size_t>(i)] = static_cast<int>(result.regions.size());
  }
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
