#include <placegraph/frontend/lines/line_initializer.h>
#include <placegraph/frontend/lines/relative_pose_from_lines.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

/// Maximum residual in the middle image of a line from the others. Chosen.
constexpr double kMaxLineResidual_px = 3;
/// Minimum rotation of a line's plane for use in the translation. Chosen.
constexpr double kMinPlaneRotation_deg = 0.7;

using Ids = std::vector<LineId>;

Outcome failure(Outcome::Code code, const std::string& reason) {
  return Outcome::failure(code, reason);
}

Eigen::Vector3d normal_of(const Camera& camera, const TrackedLine& line) {
  return plane_normal(camera, line.seen.first, line.seen.second);
}

/// The tracks of each vanishing point of a view.
std::vector<Ids> families_of(const Camera& camera, const LineView& view,
                             const VanishingPointOptions& options, Random& random) {
  std::vector<LineSegment> segments;
  Ids ids;
  for (const auto& [id, line] : view) {
    segments.push_back(line.segment);
    ids.push_back(id);
  }
  const VanishingPoints found = find_vanishing_points(segments, camera, options, random);
  std::vector<Ids> clusters(found.points.size());
  for (std::size_t i = 0; i < found.labels.size(); ++i)
    if (found.labels[i] >= 0) clusters[static_cast<std::size_t>(found.labels[i])].push_back(ids[i]);
  return clusters;
}

struct Direction {
  Eigen::Vector3d v;
  double sigma_rad;
};

/// The direction orthogonal to the normals of a family's planes: least squares over the sines, each
/// weighted by the accuracy of its segment's direction, reweighted (Cauchy).
std::optional<Direction> direction_of(const Camera& camera, const LineView& view,
                                      const Ids& cluster) {
  // Two lines determine a direction, the third one tests it; iterations.
  constexpr std::size_t kLeast = 3;
  constexpr int kRounds = 5;
  constexpr double kFloorRad = 2e-3;  // least deviation of edges from parallel
  std::vector<std::pair<Eigen::Vector3d, double>> planes;
  for (const LineId id : cluster) {
    const auto line = view.find(id);
    if (line == view.end()) continue;
    const double length = std::max(1.0, line->second.segment.length());
    planes.emplace_back(normal_of(camera, line->second),
                        std::hypot(kFloorRad, 2 * line->second.seen.sigma_px / length));
  }
  if (planes.size() < kLeast) return std::nullopt;
  std::vector<double> weights(planes.size(), 1);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  Direction result{Eigen::Vector3d::UnitZ(), 1};
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < planes.size(); ++i)
      A += weights[i] / (planes[i].second * planes[i].second) * planes[i].first *
           planes[i].first.transpose();
    eigen.compute(A);
    result.v = eigen.eigenvectors().col(0);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double off = planes[i].first.dot(result.v) / (3 * planes[i].second);
      weights[i] = 1 / (1 + off * off);
    }
  }
  // Planes of a family with little rotation about the direction leave it undetermined along
  // themselves.
  result.sigma_rad = 1 / std::sqrt(std::max(1e-12, eigen.eigenvalues()[1]));
  // Deviation of a direction that is used: 1.7 degrees. Chosen.
  constexpr double kMostRad = 0.03;
  if (!(result.sigma_rad < kMostRad)) return std::nullopt;
  return result;
}

RotationFromDirections rotation_between(const Camera& camera, const LineView& ref,
                                        const LineView& cur, const std::vector<Ids>& clusters,
                                        const SO3& guess) {
  std::vector<DirectionPair> pairs;
  for (const Ids& cluster : clusters) {
    Ids common;
    for (const LineId id : cluster)
      if (cur.contains(id)) common.push_back(id);
    const auto a = direction_of(camera, ref, common), b = direction_of(camera, cur, common);
    if (a && b) pairs.push_back({a->v, b->v, std::hypot(a->sigma_rad, b->sigma_rad)});
  }
  return rotation_from_directions(pairs, guess);
}

/// The tracks of the first view that are also in two others.
Ids common_tracks(const LineView& first, const LineView& second, const LineView& third) {
  Ids common;
  for (const auto& [id, line] : first)
    if (second.contains(id) && third.contains(id)) common.push_back(id);
  return common;
}

/// Three views of known rotation, and the lines that moved in them.
struct Three {
  const Camera& camera;
  std::array<const LineView*, 3> views;
  std::array<SO3, 3> R_view_ref;
  Ids ids;
  std::vector<LineNormals> normals;

  /// Adds the tracks whose planes rotate by at least `min_rotation_rad` from the first to the last
  /// view.
  void take(const Ids& tracks, double min_rotation_rad) {
    for (const LineId id : tracks) {
      LineNormals m;
      for (std::size_t k = 0; k < 3; ++k) m[k] = normal_of(camera, views[k]->at(id));
      const double sine = m[0].cross(R_view_ref[2].inverse() * m[2]).norm();
      if (sine < std::sin(min_rotation_rad)) continue;
      ids.push_back(id);
      normals.push_back(m);
    }
  }
  std::vector<SE3> poses(const Eigen::Vector3d& t_21, const Eigen::Vector3d& t_31) const {
    return {SE3(), SE3(R_view_ref[1], t_21).inverse(), SE3(R_view_ref[2], t_31).inverse()};
  }
  std::optional<Line3> place(std::size_t i, const std::vector<SE3>& T_ref_view) const {
    const Eigen::Vector3d n = T_ref_view[2].rotation() * normals[i][2];
    return meet(normals[i][0], 0, n, n.dot(T_ref_view[2].translation()));
  }
  /// Error in the middle view of the line from the first and the last; infinite behind any of them.
  double squared_error(std::size_t i, const std::vector<SE3>& T_ref_view) const {
    // Above any squared error.
    constexpr double kInfinity = 1e30;
    const auto line = place(i, T_ref_view);
    if (!line) return kInfinity;
    for (std::size_t k = 0; k < 3; ++k) {
      const LineSegment& s = views[k]->at(ids[i]).segment;
      const auto z = depth_on_line(camera, T_ref_view[k], *line, s.middle());
      if (!z || !(*z > 0)) return kInfinity;
    }
    const auto& seen = views[1]->at(ids[i]).seen;
    const auto r = line_residual_px(camera, T_ref_view[1], *line, seen.first, seen.second);
    return r ? r->cwiseAbs2().maxCoeff() : kInfinity;
  }
};

RansacResult<std::vector<SE3>> translate(const Three& three, const LineInitializerOptions& options,
                                         Random& random) {
  // Deviation of a normal. Chosen.
  constexpr double kSigmaRad = 1e-3;
  const auto solve_for = [&](const std::vector<int>& which) {
    std::vector<LineNormals> lines;
    for (const int i : which) lines.push_back(three.normals[static_cast<std::size_t>(i)]);
    const auto t =
        translation_from_three_views(lines, three.R_view_ref[1], three.R_view_ref[2], kSigmaRad);
    std::vector<std::vector<SE3>> models;
    if (!(t.t_31.norm() > 1e-3)) return models;
    for (const double sign : {1.0, -1.0})
      models.push_back(three.poses(sign * t.t_21, sign * t.t_31));
    return models;
  };
  const auto error = [&](const std::vector<SE3>& T_ref_view, int i) {
    return three.squared_error(static_cast<std::size_t>(i), T_ref_view);
  };
  const auto refine = [&](const std::vector<SE3>& T_ref_view, const std::vector<int>& inliers) {
    for (const auto& model : solve_for(inliers))
      if (model[2].translation().dot(T_ref_view[2].translation()) > 0) return model;
    return T_ref_view;
  };
  // Six unknowns up to scale.
  constexpr int kSample = 5;
  return ransac<std::vector<SE3>>(static_cast<int>(three.ids.size()), kSample,
                                  kMaxLineResidual_px * kMaxLineResidual_px, options.ransac, random,
                                  solve_for, error, refine);
}

/// Triangulates every line from all views with a pose.
std::map<LineId, Line3> place_lines(const Camera& camera, const std::vector<LineView>& views,
                                    const std::vector<std::optional<SE3>>& T_ref_view) {
  LineTriangulationOptions options;
  options.min_rotation_deg = 0.5;
  options.min_rotation_sigmas = 5;
  options.max_error_sigmas = 20;  // the poses are still preliminary
  std::map<LineId, Line3> lines;
  std::map<LineId, std::vector<LineMeasurement>> observations;
  for (std::size_t k = 0; k < views.size(); ++k)
    if (T_ref_view[k])
      for (const auto& [id, line] : views[k])
        observations[id].push_back({*T_ref_view[k], line.seen});
  for (const auto& [id, seen] : observations) {
    const auto line = triangulate_line(camera, seen, options);
    if (line.outcome) lines.emplace(id, line.line_ref);
  }
  return lines;
}

PoseFromLines pose_view(const Camera& camera, const LineView& view,
                        const std::map<LineId, Line3>& lines, const SE3& expected, Random& random) {
  constexpr double kSigma = 0.1;  // [rad], [translation from first to last view]
  std::vector<SeenLine> seen;
  for (const auto& [id, line] : lines)
    if (const auto at = view.find(id); at != view.end()) seen.push_back({line, at->second.seen});
  PoseFromLinesOptions pose;
  pose.threshold_px = kMaxLineResidual_px;
  const PoseGuess guess{expected, Matrix6d::Identity() / (kSigma * kSigma)};
  return estimate_pose_from_lines(camera, seen, pose, random, &guess);
}

/// Predicted pose of a view between two others at constant velocity.
SE3 expected_between(const SE3& T_ref_from, const SE3& T_ref_to, double share) {
  return T_ref_from * SE3::exp(share * (T_ref_from.inverse() * T_ref_to).log());
}

/// Estimates the poses of the views between two known ones from the lines; a view without a
/// consistent pose remains without one.
void pose_between(const Camera& camera, const std::vector<LineView>& views, std::size_t from,
                  std::size_t to, const std::map<LineId, Line3>& lines, Random& random,
                  std::vector<std::optional<SE3>>& T_ref_view) {
  for (std::size_t k = from + 1; k < to; ++k) {
    const double share = static_cast<double>(k - from) / static_cast<double>(to - from);
    const SE3 expected = expected_between(*T_ref_view[from], *T_ref_view[to], share);
    const auto pose = pose_view(camera, views[k], lines, expected, random);
    if (pose.outcome) T_ref_view[k] = pose.T_ref_cam;
  }
}

}  // namespace

LineInitialization initialize_from_lines(const Camera& camera, const std::vector<LineView>& views,
                                         const LineInitializerOptions& options, Random& random) {
  options.check();
  LineInitialization result;
  const std::size_t n = views.size();
  if (n < 3) {
    result.outcome = failure(Outcome::Code::kTooFewData,
                             std::to_string(n) + " views of lines, three are needed");
    return result;
  }
  const std::size_t middle = n / 2;
  Three three{camera, {&views[0], &views[middle], &views[n - 1]}, {}, {}, {}};
  const Ids common = common_tracks(views.front(), views[middle], views.back());
  if (static_cast<int>(common.size()) < options.min_lines) {
    result.outcome =
        failure(Outcome::Code::kTooFewData, std::to_string(common.size()) + " lines in all views");
    return result;
  }
  const std::vector<Ids> clusters = families_of(camera, views.front(), options.directions, random);
  for (std::size_t k = 1; k < 3; ++k) {
    const auto rotation =
        rotation_between(camera, views.front(), *three.views[k], clusters, three.R_view_ref[k - 1]);
    if (!rotation.outcome) {
      result.outcome = failure(rotation.outcome.code, "rotation: " + rotation.outcome.reason);
      return result;
    }
    three.R_view_ref[k] = rotation.R_cur_ref;
  }
  three.take(common, deg_to_rad(kMinPlaneRotation_deg));
  result.candidates = static_cast<int>(three.ids.size());
  const auto found = translate(three, options, random);
  result.inliers = static_cast<int>(found.inliers.size());
  if (!found.outcome) {
    result.outcome = failure(found.outcome.code, "translation: " + found.outcome.reason);
    return result;
  }
  const double unit = 1 / found.model[2].translation().norm();
  std::vector<std::optional<SE3>> T_ref_view(n);
  T_ref_view[0] = SE3();
  T_ref_view[middle] = found.model[1].scaled(unit);
  T_ref_view[n - 1] = found.model[2].scaled(unit);
  result.lines = place_lines(camera, views, T_ref_view);
  pose_between(camera, views, 0, middle, result.lines, random, T_ref_view);
  pose_between(camera, views, middle, n - 1, result.lines, random, T_ref_view);
  for (const auto& pose : T_ref_view)
    if (!pose) {
      result.outcome =
          failure(Outcome::Code::kInconsistent, "no pose agrees with an intermediate view");
      return result;
    }
  for (const auto& pose : T_ref_view) result.T_ref_view.push_back(*pose);
  result.lines = place_lines(camera, views, T_ref_view);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
