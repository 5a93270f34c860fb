#include <placegraph/frontend/vanishing/manhattan_fit.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum log odds, from the angles between the axes, that they are orthogonal. Chosen.
constexpr double kMinOrthogonality = 1;

/// Directions of a fit nearer than this are the same.
constexpr double kSameRad = 5 * kRadPerDeg;

struct Candidate {
  SO3 R_cam_axes;
  float score = 0;
};

/// Axes along v1, across it towards v2, and the third one.
SO3 axes_of(const Eigen::Vector3d& v1, const Eigen::Vector3d& v2) {
  Eigen::Matrix3d R;
  R.col(0) = v1;
  R.col(1) = (v2 - v1.dot(v2) * v1).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return SO3(Eigen::Quaterniond(R));
}

double angle_between(const SO3& a, const SO3& b) { return (a.inverse() * b).log().norm(); }

/// Candidate frames with the quick gain of all lines.
class Candidates {
 public:
  Candidates(const VanishingEvidence& evidence, const VanishingPoints& points)
      : evidence_(evidence), points_(points) {
    for (auto* gains : {&first_, &second_, &third_}) gains->resize(evidence.size());
  }

  /// Adds frames of two vanishing points at about right angles.
  void add_pairs() {
    constexpr double kMaxSine = 0.14;  // 8 degrees
    for (std::size_t i = 0; i < points_.points.size(); ++i) {
      set_first(direction(i));
      for (std::size_t j = 0; j < points_.points.size(); ++j)
        if (i != j && std::abs(direction(i).dot(direction(j))) < kMaxSine) add(direction(j));
    }
  }

  /// Adds frames of a vanishing point and a line through an orthogonal one, for the longest lines.
  void add_lines(std::size_t max_points, std::size_t max_lines) {
    std::vector<int> longest(static_cast<std::size_t>(evidence_.size()));
    for (std::size_t i = 0; i < longest.size(); ++i) longest[i] = static_cast<int>(i);
    std::stable_sort(longest.begin(), longest.end(),
                     [&](int a, int b) { return evidence_.length(a) > evidence_.length(b); });
    for (std::size_t p = 0; p < std::min(max_points, points_.points.size()); ++p) {
      set_first(direction(p));
      std::size_t used = 0;
      for (const int line : longest) {
        if (points_.labels[static_cast<std::size_t>(line)] == static_cast<int>(p)) continue;
        const Eigen::Vector3d v2 = direction(p).cross(evidence_.normal(line));
        // Three degrees: nearer directions determine no axis. Chosen.
        constexpr double kLeastSine = 0.05;
        if (v2.norm() < kLeastSine) continue;
        add(v2.normalized());
        if (++used == max_lines) break;
      }
    }
  }

  /// The best frames, with a least angle between them.
  std::vector<SO3> best(std::size_t count) {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    std::vector<SO3> result;
    for (const Candidate& candidate : found_) {
      if (result.size() == count) break;
      const SO3& R = candidate.R_cam_axes;
      if (std::none_of(result.begin(), result.end(), [&](const SO3& other) {
            return angle_between(nearest_axes(R, other), other) < kSameRad / 2;
          }))
        result.push_back(R);
    }
    return result;
  }

 private:
  static constexpr double kSearchCost = 1.1;  ///< cost of an axis's share [nats]

  const Eigen::Vector3d& direction(std::size_t p) const { return points_.points[p].direction; }
  void set_first(const Eigen::Vector3d& v) {
    v1_ = v;
    evidence_.quick_gains(v, kSearchCost, first_);
  }
  void add(const Eigen::Vector3d& v2) {
    const SO3 R = axes_of(v1_, v2);
    const Eigen::Matrix3d M = R.matrix();
    evidence_.quick_gains(M.col(1), kSearchCost, second_);
    evidence_.quick_gains(M.col(2), kSearchCost, third_);
    found_.push_back({R, first_.max(second_).max(third_).sum()});
  }

  const VanishingEvidence& evidence_;
  const VanishingPoints& points_;
  Eigen::ArrayXf first_, second_, third_;
  Eigen::Vector3d v1_ = Eigen::Vector3d::UnitZ();
  std::vector<Candidate> found_;
};

ManhattanFrame frame_of(const ManhattanFit& fit, const SO3& like) {
  ManhattanFrame frame;
  frame.R_cam_manhattan = nearest_axes(fit.R_cam_axes, like);
  // Old axis that corresponds to each new one, up to its sign: coordinates w' = P w.
  const Eigen::Matrix3d P =
      (frame.R_cam_manhattan.matrix().transpose() * fit.R_cam_axes.matrix()).array().round();
  frame.information = P * fit.information * P.transpose();
  std::array<int, 3> place{};
  for (int old = 0; old < 3; ++old) {
    Eigen::Index now = 0;
    P.col(old).cwiseAbs().maxCoeff(&now);
    place[static_cast<std::size_t>(old)] = static_cast<int>(now);
    frame.segments[static_cast<std::size_t>(now)] = fit.lines[static_cast<std::size_t>(old)];
    frame.evidence[static_cast<std::size_t>(now)] = fit.evidence[static_cast<std::size_t>(old)];
  }
  for (const int a : fit.axis)
    frame.axis.push_back(a < 0 ? -1 : place[static_cast<std::size_t>(a)]);
  frame.orthogonality_deg = fit.orthogonality_rad / kRadPerDeg;
  constexpr double kLeast = 30;  // a deviation of 10 degrees
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(frame.information);
  for (int k = 0; k < 3; ++k) frame.rank += eigen.eigenvalues()[k] > kLeast;
  if (frame.rank == 3) {
    frame.covariance = frame.information.inverse();
  } else {  // axes without observations get no information
    frame.information.setZero();
    for (int k = 0; k < 3; ++k)
      if (eigen.eigenvalues()[k] > kLeast)
        frame.information += eigen.eigenvalues()[k] * eigen.eigenvectors().col(k) *
                             eigen.eigenvectors().col(k).transpose();
  }
  return frame;
}

bool seen(const ManhattanFit& fit, std::size_t a, const ManhattanOptions& options) {
  return fit.lines[a] >= options.min_segments && fit.evidence[a] >= options.min_evidence;
}

/// Log odds that the directions which the axes' own lines determine are orthogonal: from their
/// deviations from right angles, against any angle.
double right_angle_log_odds(const VanishingEvidence& evidence, const ManhattanFit& fit,
                            const ManhattanOptions& options) {
  const double s = options.orthogonality_deg * kRadPerDeg;
  std::array<AxisOffset, 3> own;
  for (std::size_t a = 0; a < 3; ++a)
    if (seen(fit, a, options)) own[a] = own_direction(evidence, fit, static_cast<int>(a));
  double log_odds = 0;
  int pairs = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    if (!own[a].ok || !own[b].ok) continue;
    const Eigen::Vector3d &va = own[a].direction, &vb = own[b].direction;
    const double off = std::asin(std::clamp(va.dot(vb), -1.0, 1.0));
    const double variance =
        2 * s * s + vb.dot(own[a].covariance * vb) + va.dot(own[b].covariance * va);
    log_odds += 0.5 * std::log(std::numbers::pi / (2 * variance)) - 0.5 * off * off / variance;
    ++pairs;
  }
  return pairs > 0 ? log_odds : -std::numeric_limits<double>::infinity();
}

/// Whether an axis of this frame has enough lines that belong to no previous frame, and is also a
/// vanishing point.
bool shows_more(const VanishingEvidence& evidence, const ManhattanFit& fit,
                const VanishingPoints& points, const std::vector<ManhattanFit>& before,
                const ManhattanOptions& options) {
  if (before.empty()) return true;
  constexpr double kShareCost = 2.3;  // cost of the share of a tenth of the lines [nats]
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d v = fit.R_cam_axes.matrix().col(a);
    int lines = 0;
    double gain = 0;
    for (int i = 0; i < evidence.size(); ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      if (fit.axis[k] != a || std::any_of(before.begin(), before.end(),
                                          [&](const ManhattanFit& f) { return f.axis[k] >= 0; }))
        continue;
      ++lines;
      gain += evidence.weight(i) * (evidence.log_ratio(i, v) - kShareCost);
    }
    if (lines >= options.min_segments && gain >= options.min_evidence &&
        std::any_of(points.points.begin(), points.points.end(), [&](const VanishingPoint& p) {
          return std::abs(p.direction.dot(v)) > std::cos(kSameRad);
        }))
      return true;
  }
  return false;
}

}  // namespace

SO3 nearest_axes(const SO3& R_cam_manhattan, const SO3& like) {
  const Eigen::Matrix3d M = R_cam_manhattan.matrix();
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  double best = -4;
  Eigen::Matrix3d nearest = M;
  for (const auto& order : kOrders) {
    for (int signs = 0; signs < 4; ++signs) {
      Eigen::Matrix3d P;
      double trace = 0;
      for (int j = 0; j < 3; ++j) {
        const double sign = j < 2 ? ((signs >> j) & 1 ? -1 : 1) : 1;
        P.col(j) = sign * M.col(order[j]);
        if (j == 2) P.col(2) = P.col(0).cross(P.col(1));
        trace += P.col(j).dot(like.matrix().col(j));
      }
      if (trace > best) best = trace, nearest = P;
    }
  }
  return SO3(Eigen::Quaterniond(nearest));
}

std::vector<ManhattanFrame> find_manhattan_frames(const VanishingEvidence& evidence,
                                                  const VanishingPoints& points,
                                                  const ManhattanOptions& options) {
  options.check();
  // Points and lines that make candidates, and candidates that are fitted: the cost. Chosen.
  constexpr std::size_t kPoints = 3, kLines = 60, kFits = 5;
  constexpr double kWidenRad = 1.5 * kRadPerDeg;
  Candidates candidates(evidence, points);
  candidates.add_pairs();
  candidates.add_lines(kPoints, kLines);
  std::vector<ManhattanFit> fits;
  for (const SO3& R : candidates.best(kFits))
    fits.push_back(
        fit_manhattan(evidence, R, options.orthogonality_deg * kRadPerDeg, kWidenRad, 3));
  std::stable_sort(fits.begin(), fits.end(),
                   [](const ManhattanFit& a, const ManhattanFit& b) { return a.cost < b.cost; });
  std::vector<ManhattanFrame> frames;
  std::vector<ManhattanFit> taken;
  for (const ManhattanFit& fit : fits) {
    if (seen(fit, 0, options) + seen(fit, 1, options) + seen(fit, 2, options) < 2) continue;
    const double log_odds = right_angle_log_odds(evidence, fit, options);
    if (log_odds < kMinOrthogonality || !shows_more(evidence, fit, points, taken, options))
      continue;
    ManhattanFrame frame = frame_of(fit, SO3());
    if (frame.rank < 3) continue;
    frame.log_odds = log_odds;
    frame.outcome = Outcome::ok();
    frames.push_back(std::move(frame));
    taken.push_back(fit);
  }
  return frames;
}

ManhattanFrame estimate_manhattan_frame(const std::vector<LineSegment>& segments,
                                        const Camera& camera, const VanishingPointOptions& points,
                                        const ManhattanOptions& options, Random& random) {
  VanishingEvidence evidence(segments, camera, points.noise);
  const VanishingPoints found = find_vanishing_points(evidence, points, random);
  ManhattanFrame frame;
  frame.outcome = found.outcome;
  if (found.outcome) {
    std::vector<ManhattanFrame> frames = find_manhattan_frames(evidence, found, options);
    if (!frames.empty())
      frame = std::move(frames.front());
    else
      frame.outcome =
          Outcome::failure(Outcome::Code::kNoConsensus, "no two directions at right angles");
  }
  spread_labels(evidence, segments.size(), frame.axis);
  return frame;
}

ManhattanFrame track_manhattan_frame(const std::vector<LineSegment>& segments, const Camera& camera,
                                     const SO3& R_cam_manhattan_predicted, double sigma_rad,
                                     const VanishingNoise& noise, const ManhattanOptions& options) {
  options.check();
  require(sigma_rad > 0 && sigma_rad < 1, "track_manhattan_frame: sigma_rad outside (0, 1)");
  VanishingEvidence evidence(segments, camera, noise);
  ManhattanFrame frame;
  frame.R_cam_manhattan = R_cam_manhattan_predicted;
  frame.axis.assign(segments.size(), -1);
  if (evidence.size() < options.min_segments) {
    frame.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                     std::to_string(evidence.size()) + " segments, " +
                                         std::to_string(options.min_segments) + " needed");
    return frame;
  }
  const double orthogonality_rad = options.orthogonality_deg * kRadPerDeg;
  ManhattanFit fit =
      fit_manhattan(evidence, R_cam_manhattan_predicted, orthogonality_rad, sigma_rad, 3);
  const Eigen::Matrix3d M = fit.R_cam_axes.matrix();
  evidence.fit_noise({M.col(0), M.col(1), M.col(2)}, fit.axis);
  fit = fit_manhattan(evidence, fit.R_cam_axes, orthogonality_rad, 0, 2);
  frame = frame_of(fit, R_cam_manhattan_predicted);
  spread_labels(evidence, segments.size(), frame.axis);
  if (!seen(fit, 0, options) && !seen(fit, 1, options) && !seen(fit, 2, options))
    frame.outcome = Outcome::failure(Outcome::Code::kDegenerate, "the segments show no axis");
  else
    frame.outcome = Outcome::ok();
  return frame;
}

}  // namespace placegraph
