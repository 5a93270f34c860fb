#include <fmt/format.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/pipeline/health/right_image_time.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

struct Equation {
  Vector7d terms;  // offset (y, z), then rotation
  double rows = 0;
};

std::optional<Equation> equation_of(const Camera& camera, const StereoMatch& match) {
  const auto left = camera.unproject(match.px_left), right = camera.unproject(match.px_right);
  if (!left || !right) return std::nullopt;
  const double x = left->x(), y = left->y(), d = x - right->x(), rows = right->y() - y;
  Equation equation;
  equation.terms << -d, d * right->y() + rows * right->x(), 1, x, y, x * y, y * y;
  equation.rows = rows;
  return equation;
}

/// Points that are tracked from the left into the right image, in both directions.
std::vector<StereoMatch> matches_of(const Frame& frame) {
  PointTrackerOptions options;
  options.max_tracks = 120;
  options.max_anchor_shift_px = 0;
  options.cell_px = 96;
  PointTracker tracker(options);
  tracker.track(frame.image);
  tracker.detect(frame.mask);
  tracker.track(frame.right);
  std::vector<StereoMatch> matches;
  for (const PointTrack& track : tracker.tracks())
    matches.push_back({track.px_previous.cast<double>(), track.px.cast<double>()});
  return matches;
}

}  // namespace

std::optional<RightCameraOffset> right_camera_offset(const Camera& camera,
                                                     const std::vector<StereoMatch>& matches) {
  // Matches, for seven unknowns. Chosen.
  constexpr std::size_t kFewest = 30;
  // Noise of a match, widest kernel of the graduated fit, prior deviations of rotation [rad] and
  // share. Chosen.
  constexpr double kSigmaPx = 0.5, kWidestPx = 8, kPriorRotation = 0.02, kPriorShare = 10;
  std::vector<Equation> equations;
  for (const StereoMatch& match : matches)
    if (const auto equation = equation_of(camera, match)) equations.push_back(*equation);
  if (equations.size() < kFewest) return std::nullopt;
  Vector7d prior = Vector7d::Constant(1 / (kPriorRotation * kPriorRotation));
  prior.head<2>().setConstant(1 / (kPriorShare * kPriorShare));
  Vector7d estimate = Vector7d::Zero();
  Matrix7d information;
  // Cauchy weights; their width decreases from that of any plausible error to that of the noise.
  for (double width_px = kWidestPx; width_px > 0.4 * kSigmaPx; width_px *= 0.7) {
    information = prior.asDiagonal();
    Vector7d right = Vector7d::Zero();
    const double width = std::max(width_px, kSigmaPx) / camera.fy;
    for (const Equation& e : equations) {
      const double error = (e.rows - e.terms.dot(estimate)) / width;
      const double sigma = kSigmaPx / camera.fy;
      const double weight = 1 / (sigma * sigma * (1 + error * error));
      information += weight * e.terms * e.terms.transpose();
      right += weight * e.rows * e.terms;
    }
    estimate = information.ldlt().solve(right);
  }
  const Matrix7d covariance = information.ldlt().solve(Matrix7d::Identity());
  return RightCameraOffset{estimate.head<2>(), covariance.topLeftCorner<2, 2>().inverse()};
}

RightImageTime::RightImageTime(const Calibration& calibration)
    : camera_(calibration.camera), baseline_m_(calibration.baseline_m) {}

void RightImageTime::add(const Frame& frame, const std::optional<SE3>& T_map_cam) {
  // Takes about a hundredth of the time of a run.
  constexpr int kFramesAPair = 12;
  constexpr double kLeastMotion = 0.1;  // share of the baseline
  const std::optional<SE3> T_map_last = std::exchange(T_map_last_, T_map_cam);
  ++frames_since_pair_;
  if (!(baseline_m_ > 0) || frame.right.empty() || !T_map_last || !T_map_cam ||
      frames_since_pair_ < kFramesAPair)
    return;
  const Eigen::Vector3d motion_m = (T_map_last->inverse() * *T_map_cam).translation();
  if (motion_m.tail<2>().norm() < kLeastMotion * baseline_m_) return;
  frames_since_pair_ = 0;
  if (const auto offset = right_camera_offset(camera_, matches_of(frame))) add(*offset, motion_m);
}

void RightImageTime::add(const RightCameraOffset& offset, const Eigen::Vector3d& motion_m) {
  pairs_.push_back({offset, motion_m.tail<2>() / baseline_m_});
}

/// Least squares over `offset = lateness * motion`.
RightImageTime::Lateness RightImageTime::lateness() const {
  double information = 0, right = 0, dispersion = 0;
  for (const Pair& pair : pairs_) {
    const Eigen::Vector2d weighted = pair.offset.information * pair.motion_yz_share;
    information += weighted.dot(pair.motion_yz_share);
    right += weighted.dot(pair.offset.yz_share);
  }
  if (!(information > 0)) return {};
  const double frames = right / information;
  for (const Pair& pair : pairs_) {
    const Eigen::Vector2d error = pair.offset.yz_share - frames * pair.motion_yz_share;
    dispersion += error.dot(pair.offset.information * error);
  }
  const double freedom = 2 * static_cast<double>(pairs_.size()) - 1;
  return {frames, std::sqrt(std::max(1.0, dispersion / freedom) / information)};
}

std::optional<DataNote> RightImageTime::note() const {
  // Pairs that are judged. Chosen.
  constexpr std::size_t kFewest = 3;
  // Lateness in frames that is reported, and its deviations. Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr double kLeast = 0.1, kSigmas = 5;
  const Lateness late = lateness();
  if (pairs_.size() < kFewest || !(std::abs(late.frames) > std::max(kLeast, kSigmas * late.sigma)))
    return std::nullopt;
  double baselines = 0;
  for (const Pair& pair : pairs_) baselines += pair.offset.yz_share.norm();
  baselines /= static_cast<double>(pairs_.size());
  return DataNote{
      fmt::format("matches in {} pairs of images put the right camera {:.2g} baselines {} the left "
                  "one in the direction of motion: its images were taken at another time",
                  pairs_.size(), baselines, late.frames > 0 ? "ahead of" : "behind"),
      true, NoteCause::kRightImageLate,
      fmt::format("pair each left image with the {} right image, or trigger both cameras together",
                  late.frames > 0 ? "previous" : "next")};
}

}  // namespace placegraph
