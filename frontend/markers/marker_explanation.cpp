#include <placegraph/frontend/markers/marker_explanation.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/chi_squared.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Eigen::Vector3d;

/// Log-likelihood of an explanation: squares outside the gate and beacons without a spot count as
/// at the gate.
double log_likelihood_of(const Camera& camera, const std::vector<SeenSquare>& squares,
                         const std::vector<SeenPoint>& points, double gate, double point_gate,
                         const SE3& T_ref_cam) {
  double log_likelihood_sum = 0;
  for (const SeenSquare& square : squares)
    log_likelihood_sum += log_likelihood(std::min(gate, square_chi2(camera, square, T_ref_cam)), 8);
  for (const SeenPoint& point : points)
    log_likelihood_sum +=
        log_likelihood(std::min(point_gate, point_chi2(camera, point, T_ref_cam)), 2) -
        log_likelihood(point_gate, 2);
  return log_likelihood_sum;
}

std::vector<SeenSquare> pick(const std::vector<SeenSquare>& squares,
                             const std::vector<int>& which) {
  std::vector<SeenSquare> picked;
  for (const int i : which) picked.push_back(squares[i]);
  return picked;
}

std::vector<SeenPoint> points_of(const std::vector<BeaconObservation>& spots,
                                 const std::vector<Vector3d>& beacons_world,
                                 const BeaconPairs& pairs) {
  std::vector<SeenPoint> points;
  for (const auto& [spot, beacon] : pairs)
    points.push_back({spots[spot].px, beacons_world[beacon], spots[spot].covariance.inverse()});
  return points;
}

/// The common plane of all squares, if there is one.
struct Plane {
  Vector3d centre = Vector3d::Zero(), normal = Vector3d::UnitZ();
};
std::optional<Plane> common_plane(const std::vector<SeenSquare>& squares) {
  Plane plane;
  if (squares.empty()) return std::nullopt;
  for (const SeenSquare& square : squares)
    plane.centre += 0.5 * (square.corners_ref[0] + square.corners_ref[2]);
  plane.centre /= static_cast<double>(squares.size());
  const auto& first = squares.front().corners_ref;
  plane.normal = (first[1] - first[0]).cross(first[0] - first[3]).normalized();
  constexpr double kFlat = 0.02;  // share of a square's side
  for (const SeenSquare& square : squares)
    for (const Vector3d& corner : square.corners_ref)
      if (std::abs(plane.normal.dot(corner - first[0])) > kFlat * (first[1] - first[0]).norm())
        return std::nullopt;
  return plane;
}

/// Solves all squares together from a start; outliers are left out, worst first.
MarkerExplanation solve(const Camera& camera, const std::vector<SeenSquare>& squares,
                        const SE3& start, double gate) {
  MarkerExplanation result;
  std::vector<int> kept(squares.size());
  for (std::size_t i = 0; i < squares.size(); ++i) kept[i] = static_cast<int>(i);
  while (!kept.empty()) {
    const std::vector<SeenSquare> used = pick(squares, kept);
    result.pose = refine_square_pose(camera, used, {}, start);
    if (!result.pose.outcome) return result;
    double worst = gate;
    std::size_t at = kept.size();
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const double chi2 = square_chi2(camera, used[k], result.pose.T_ref_cam);
      if (chi2 <= worst) continue;
      worst = chi2;
      at = k;
    }
    if (at == kept.size()) break;
    if (kept.size() == 1) {
      // A single marker is always kept: its error counts in the log-likelihood.
      break;
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(at));
  }
  result.squares = kept;
  return result;
}

/// Adds the beacons that the pose assigns unambiguously.
void add_beacons(const Camera& camera, const std::vector<SeenSquare>& squares,
                 const std::vector<BeaconObservation>& spots,
                 const std::vector<Vector3d>& beacons_world, const BeaconPoseOptions& options,
                 MarkerExplanation& explanation) {
  const BeaconPairs pairs = assign_beacons(spots, beacons_world, camera, explanation.pose.T_ref_cam,
                                           explanation.pose.covariance, options);
  if (pairs.empty()) return;
  const std::vector<SeenPoint> points = points_of(spots, beacons_world, pairs);
  const SquarePose joint = refine_square_pose(camera, pick(squares, explanation.squares), points,
                                              explanation.pose.T_ref_cam);
  if (!joint.outcome) return;
  // Spots that increase the squares' error beyond the gate are wrong assignments.
  const int rows = 2 * static_cast<int>(points.size());
  if (joint.chi2 - explanation.pose.chi2 > chi_squared_quantile(options.gate, rows)) return;
  explanation.pose = joint;
  explanation.beacons = pairs;
}

/// Both poses of every single square.
std::vector<SE3> starts_of(const Camera& camera, const std::vector<SeenSquare>& squares) {
  std::vector<SE3> starts;
  for (const SeenSquare& square : squares) {
    MarkerObservation alone;
    alone.corners_px = square.corners_px;
    alone.covariance = square.information.inverse();
    const auto& corners = square.corners_ref;
    const Vector3d right = corners[1] - corners[0], up = corners[0] - corners[3];
    Eigen::Matrix3d R;
    R << right.normalized(), up.normalized(), right.cross(up).normalized();
    const SE3 T_world_marker(R, Vector3d(0.5 * (corners[0] + corners[2])));
    for (const MarkerPose& pose : estimate_marker_poses(alone, right.norm(), camera).poses)
      starts.push_back(T_world_marker * pose.T_cam_marker.inverse());
  }
  return starts;
}

void keep(MarkerExplanation explanation, std::vector<MarkerExplanation>& found) {
  const bool known = std::any_of(found.begin(), found.end(), [&](const MarkerExplanation& other) {
    return same_minimum(other.pose, explanation.pose);
  });
  if (explanation.pose.outcome && !known) found.push_back(std::move(explanation));
}

/// Pose from beacons alone; with `expected` three of them are enough.
MarkerExplanation by_beacons(const Camera& camera, const std::vector<BeaconObservation>& spots,
                             const std::vector<Vector3d>& beacons_world,
                             const BeaconPoseOptions& options,
                             const std::optional<KnownCamera>& expected) {
  MarkerExplanation explanation;
  if (expected) {
    explanation.beacons = assign_beacons(spots, beacons_world, camera, expected->T_world_cam,
                                         expected->covariance, options);
    explanation.pose = refine_square_pose(
        camera, {}, points_of(spots, beacons_world, explanation.beacons), expected->T_world_cam);
    return explanation;
  }
  const BeaconPose pose = find_beacon_pose(spots, beacons_world, camera, options);
  explanation.pose.outcome = pose.outcome;
  explanation.pose.T_ref_cam = pose.T_world_cam;
  explanation.pose.covariance = pose.covariance;
  explanation.pose.chi2 = pose.chi2;
  explanation.beacons = pose.pairs;
  return explanation;
}

}  // namespace

double log_likelihood(double chi2, int dimensions) {
  // Degrees of freedom of a Student t distribution, for heavy tails. Chosen.
  constexpr double kFreedom = 4;
  return -0.5 * (kFreedom + dimensions) * std::log1p(chi2 / kFreedom);
}

MarkerExplanations explain_markers(const Camera& camera, const std::vector<SeenSquare>& squares,
                                   const std::vector<BeaconObservation>& spots,
                                   const std::vector<Vector3d>& beacons_world, double gate,
                                   const BeaconPoseOptions& options,
                                   const std::optional<KnownCamera>& expected) {
  MarkerExplanations result;
  result.outcome = Outcome::failure(Code::kTooFewData, "nothing known in view");
  for (const SE3& start : starts_of(camera, squares)) {
    MarkerExplanation explanation = solve(camera, squares, start, gate);
    if (!explanation.pose.outcome) continue;
    add_beacons(camera, squares, spots, beacons_world, options, explanation);
    keep(std::move(explanation), result.found);
  }
  if (result.found.size() == 1) {
    // The plane may have been confused with its mirror image.
    if (const auto plane = common_plane(squares)) {
      MarkerExplanation other = result.found.front();
      other.pose = find_planar_rival(camera, pick(squares, other.squares),
                                     points_of(spots, beacons_world, other.beacons),
                                     other.pose.T_ref_cam, plane->centre, plane->normal);
      keep(std::move(other), result.found);
    }
  }
  if (squares.empty()) {
    MarkerExplanation explanation = by_beacons(camera, spots, beacons_world, options, expected);
    result.outcome = explanation.pose.outcome;
    keep(std::move(explanation), result.found);
  }
  // A single square is never left out.
  const double worst = squares.size() > 1 ? gate : std::numeric_limits<double>::infinity();
  for (MarkerExplanation& explanation : result.found)
    explanation.log_likelihood_sum =
        log_likelihood_of(camera, squares, points_of(spots, beacons_world, explanation.beacons),
                          worst, chi_squared_quantile(options.gate, 2), explanation.pose.T_ref_cam);
  if (!result.found.empty()) result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
