#include <placegraph/frontend/segments/local_motion.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

using Row = Eigen::Matrix<double, 6, 1>;

/// One linear equation row . (a11 a12 a21 a22 t1 t2) = value, with px_a taken from the origin.
struct Equation {
  Row row;
  double value = 0, weight = 1;
  int group = 0;  ///< the equations of one point or segment pair have a common weight
};

Row row_of(const Eigen::Vector2d& n, const Eigen::Vector2d& p) {
  Row row;
  row << n.x() * p.x(), n.x() * p.y(), n.y() * p.x(), n.y() * p.y(), n.x(), n.y();
  return row;
}

/// Distance between two segments: the least between their ends and middles.
double distance_between(const LineSegment& a, const LineSegment& b) {
  double nearest = a.distance_to(b.middle());
  for (const Eigen::Vector2d& p : {b.start, b.end}) nearest = std::min(nearest, a.distance_to(p));
  for (const Eigen::Vector2d& p : {a.start, a.end, a.middle()})
    nearest = std::min(nearest, b.distance_to(p));
  return nearest;
}

/// Iteratively reweighted least squares with a weak prior on the linear part.
Row solve_robust(const std::vector<Equation>& equations, int groups, const Eigen::Matrix2d& prior,
                 double prior_weight, std::vector<double>& group_weight) {
  // Iterations at most. Chosen.
  constexpr int kRounds = 6;
  constexpr double kScalePx = 2;  // Cauchy
  Row x;
  group_weight.assign(groups, 1.0);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 6, 6> N = Eigen::Matrix<double, 6, 6>::Zero();
    Row g = Row::Zero();
    const double priors[4] = {prior(0, 0), prior(0, 1), prior(1, 0), prior(1, 1)};
    for (int k = 0; k < 4; ++k) N(k, k) += prior_weight, g[k] += prior_weight * priors[k];
    for (int k = 4; k < 6; ++k) N(k, k) += 1e-9;
    for (const Equation& e : equations) {
      const double w = e.weight * group_weight[e.group];
      N += w * e.row * e.row.transpose();
      g += w * e.value * e.row;
    }
    x = N.ldlt().solve(g);
    std::vector<double> squared(groups, 0);
    for (const Equation& e : equations)
      squared[e.group] += (e.row.dot(x) - e.value) * (e.row.dot(x) - e.value);
    // A wide kernel at first: until the worst are downweighted, all residuals are large.
    const double scale = kScalePx * std::max(1.0, 8.0 / (1 << round));
    for (int i = 0; i < groups; ++i) group_weight[i] = 1 / (1 + squared[i] / (scale * scale));
  }
  return x;
}

}  // namespace

LocalMotionField::LocalMotionField(std::vector<PointPair> points, std::vector<SegmentPair> segments,
                                   int nearest)
    : points_(std::move(points)), segments_(std::move(segments)), nearest_(nearest) {}

std::vector<LocalMotionField::Evidence> LocalMotionField::nearest_to(const LineSegment& a,
                                                                     int without) const {
  std::vector<Evidence> all;
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    all.push_back({a.distance_to(points_[i].px_a), i, true});
  for (int i = 0; i < static_cast<int>(segments_.size()); ++i)
    if (i != without) all.push_back({distance_between(a, segments_[i].a), i, false});
  const std::size_t count = std::min<std::size_t>(all.size(), nearest_);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                    [](const Evidence& x, const Evidence& y) {
                      return std::tie(x.distance, x.is_point, x.index) <
                             std::tie(y.distance, y.is_point, y.index);
                    });
  all.resize(count);
  return all;
}

std::optional<LocalMotion> LocalMotionField::around(const LineSegment& a, int without) const {
  const std::vector<Evidence> evidence = nearest_to(a, without);
  if (evidence.size() < 3) return std::nullopt;
  const Eigen::Vector2d origin = a.middle();
  std::vector<double> distances;
  for (const Evidence& e : evidence) distances.push_back(e.distance);
  const double median_distance = median_of(distances);
  const double reach = std::max(15.0, median_distance);

  std::vector<Equation> equations;
  std::vector<double> entries[4];
  for (int i = 0; i < static_cast<int>(evidence.size()); ++i) {
    const Evidence& e = evidence[i];
    const double share = e.distance / reach, weight = 1 / (1 + share * share);
    if (e.is_point) {
      const PointPair& pair = points_[e.index];
      for (int k = 0; k < 2; ++k)
        equations.push_back(
            {row_of(Eigen::Vector2d::Unit(k), pair.px_a - origin), pair.px_b[k], weight, i});
      for (int k = 0; k < 4; ++k) entries[k].push_back(pair.rotation_b_a(k / 2, k % 2));
    } else {
      const SegmentPair& pair = segments_[e.index];
      const Eigen::Vector2d n = pair.b.normal();
      for (const Eigen::Vector2d& p : {pair.a.start, pair.a.end})
        equations.push_back({row_of(n, p - origin), n.dot(pair.b.start), weight, i});
    }
  }
  Eigen::Matrix2d prior = Eigen::Matrix2d::Identity();
  if (entries[0].empty())
    for (const PointPair& pair : points_)
      for (int k = 0; k < 4; ++k) entries[k].push_back(pair.rotation_b_a(k / 2, k % 2));
  if (!entries[0].empty())
    prior << median_of(entries[0]), median_of(entries[1]), median_of(entries[2]),
        median_of(entries[3]);

  constexpr double kPriorPx = 12;  // the prior has the weight of a point at this distance
  std::vector<double> trust;
  const Row x =
      solve_robust(equations, static_cast<int>(evidence.size()), prior, kPriorPx * kPriorPx, trust);
  LocalMotion motion;
  motion.A << x[0], x[1], x[2], x[3];
  motion.t = x.tail<2>() - motion.A * origin;
  double weights = 0, squared = 0;
  for (const Equation& e : equations) {
    const double w = e.weight * trust[e.group], r = e.row.dot(x) - e.value;
    weights += w, squared += w * r * r;
  }
  motion.rms_px = std::sqrt(squared / weights);
  motion.distance_px = median_distance;
  if (!(motion.A.determinant() > 0) || !x.allFinite()) return std::nullopt;
  return motion;
}

}  // namespace placegraph
