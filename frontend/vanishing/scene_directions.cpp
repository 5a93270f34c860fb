#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/frontend/vanishing/vanishing_search.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Deviation of further vanishing points from right angles to an axis. Chosen.
constexpr double kOffRight_deg = 2;
/// Prior share of further vanishing points in any direction. Chosen.
constexpr double kFreeShare = 0.25;

constexpr double kSame = 0.9962;  ///< cosine of 5 degrees: axes nearer than that are one

/// Axis `a` of a frame from its own lines, constrained to the frame's axis with the accuracy of the
/// right angles and of the frame.
FittedDirection axis_direction(const VanishingEvidence& evidence, const ManhattanFrame& frame,
                               int a, const ManhattanOptions& options) {
  const Eigen::Matrix3d M = frame.R_cam_manhattan.matrix();
  const Eigen::Vector3d axis = M.col(a);
  const TangentBasis B = tangent_basis(axis);
  // Three angles are a poor estimate of the deviations from right angles: the expected one is
  // always allowed.
  const double s = kRadPerDeg * std::max(frame.orthogonality_deg, options.orthogonality_deg);
  const TangentBasis J = (B.transpose() * -M * hat(Eigen::Vector3d::Unit(a))).transpose();
  const Eigen::Matrix2d prior =
      s * s * Eigen::Matrix2d::Identity() + J.transpose() * frame.covariance * J;
  std::vector<int> lines;
  for (int i = 0; i < evidence.size(); ++i)
    if (frame.axis[static_cast<std::size_t>(i)] == a) lines.push_back(i);
  FittedDirection own = fit_direction(evidence, axis, lines, 3);
  Eigen::Matrix2d covariance = prior;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  if (own.ok) {
    const Eigen::Vector3d v = own.v.dot(axis) < 0 ? Eigen::Vector3d(-own.v) : own.v;
    const Eigen::Matrix2d information = (B.transpose() * own.covariance * B).inverse();
    covariance = (information + prior.inverse()).inverse();
    offset = covariance * information * (B.transpose() * v);
  }
  FittedDirection result;
  result.ok = result.held = true;
  result.v = (axis + B * offset).normalized();
  if (result.v.z() < 0) result.v = -result.v;
  result.covariance = B * covariance * B.transpose();
  result.precision_cost = -0.5 * std::log(covariance.determinant());
  return result;
}

/// Axes of all frames with enough lines; an axis that two frames share is listed once.
std::vector<std::pair<PointRole, FittedDirection>> axes_of(
    const VanishingEvidence& evidence, const std::vector<ManhattanFrame>& frames,
    const ManhattanOptions& options) {
  std::vector<std::pair<PointRole, FittedDirection>> axes;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (int a = 0; a < 3; ++a) {
      if (frames[f].segments[static_cast<std::size_t>(a)] < options.min_segments) continue;
      const Eigen::Vector3d axis = frames[f].R_cam_manhattan.matrix().col(a);
      if (std::any_of(axes.begin(), axes.end(), [&](const auto& known) {
            return std::abs(known.second.v.dot(axis)) > kSame;
          }))
        continue;
      axes.push_back({{.frame = static_cast<int>(f), .axis = a},
                      axis_direction(evidence, frames[f], a, options)});
    }
  }
  return axes;
}

/// Whether most lines of a point are those of one axis.
bool is_axis(const std::vector<int>& labels, int point, const std::vector<ManhattanFrame>& frames,
             const ManhattanOptions& options) {
  for (const ManhattanFrame& frame : frames) {
    std::array<int, 3> shared{};
    int all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] != point) continue;
      ++all;
      if (frame.axis[i] >= 0) ++shared[static_cast<std::size_t>(frame.axis[i])];
    }
    for (std::size_t a = 0; a < 3; ++a)
      if (frame.segments[a] >= options.min_segments && 2 * shared[a] > all) return true;
  }
  return false;
}

/// Axes of all frames, one that two frames share once, with their roles.
std::pair<DirectionPrior, std::vector<PointRole>> prior_of(
    const std::vector<ManhattanFrame>& frames) {
  DirectionPrior prior;
  prior.sigma_rad = kOffRight_deg * kRadPerDeg;
  prior.free_share = kFreeShare;
  std::vector<PointRole> roles;
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d axis = frames[f].R_cam_manhattan.matrix().col(a);
      if (std::any_of(prior.axes.begin(), prior.axes.end(), [&](const Eigen::Vector3d& known) {
            return std::abs(known.dot(axis)) > kSame;
          }))
        continue;
      prior.axes.push_back(axis);
      roles.push_back({.across_frame = static_cast<int>(f), .across_axis = a});
    }
  return {prior, roles};
}

}  // namespace

SceneDirections find_scene_directions(const std::vector<LineSegment>& segments,
                                      const Camera& camera, const SceneDirectionOptions& options,
                                      Random& random) {
  options.check();
  VanishingEvidence evidence(segments, camera, options.points.noise);
  SceneDirections scene;
  scene.vanishing = find_vanishing_points(evidence, options.points, random);
  if (scene.vanishing.outcome)
    scene.frames = find_manhattan_frames(evidence, scene.vanishing, options.manhattan);
  const auto axes = axes_of(evidence, scene.frames, options.manhattan);
  std::vector<FittedDirection> directions;
  for (const auto& axis : axes) directions.push_back(axis.second);
  VanishingModel model(evidence, kPointCost_nats, options.points.min_segments);
  const auto [prior, roles_across] = prior_of(scene.frames);
  model = model.with_all(directions);
  model.expect(prior);
  // Other points, as far as the axes have left lines for them.
  for (std::size_t p = 0; p < scene.vanishing.points.size(); ++p) {
    if (is_axis(scene.vanishing.labels, static_cast<int>(p), scene.frames, options.manhattan))
      continue;
    const VanishingPoint& point = scene.vanishing.points[p];
    std::optional<VanishingModel> trial = model.with(point.direction);
    if (trial && trial->cost() < model.cost()) model = *std::move(trial);
  }
  if (scene.vanishing.outcome) {
    VanishingSearch search(evidence, options.points.samples, random);
    search.grow(model, options.points.max_points);
    std::vector<int> order;
    scene.vanishing = vanishing_points(evidence, model, order);
    for (const int z : order) {
      const auto at = static_cast<std::size_t>(z);
      const int across = model.directions()[at].across_axis;
      scene.roles.push_back(at < axes.size() ? axes[at].first
                            : across < 0     ? PointRole{}
                                             : roles_across[static_cast<std::size_t>(across)]);
    }
  }
  spread_labels(evidence, segments.size(), scene.vanishing.labels);
  for (ManhattanFrame& frame : scene.frames) spread_labels(evidence, segments.size(), frame.axis);
  return scene;
}

}  // namespace placegraph
