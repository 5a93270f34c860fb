#include <placegraph/frontend/lines/vanishing_direction_tracker.h>
#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {

/// The lines of a view as evidence, and the ids of their tracks.
struct VanishingDirectionTracker::Evidence {
  std::vector<LineId> ids;  ///< ids of the segments
  VanishingEvidence lines;

  static Evidence of(const Camera& camera, const LineView& view, const VanishingNoise& noise) {
    std::vector<LineSegment> segments;
    std::vector<LineId> ids;
    for (const auto& [id, line] : view) {
      segments.push_back(line.segment);
      ids.push_back(id);
    }
    return {std::move(ids), VanishingEvidence(segments, camera, noise)};
  }
  LineId id(int i) const { return ids[static_cast<std::size_t>(lines.segment(i))]; }
};

namespace {

/// Least standard deviation of a direction: the edges of a family are not exactly parallel, and
/// their deviations are the same in every view.
constexpr double kFloorRad = 1.5e-3;

Eigen::Matrix3d with_floor(const Eigen::Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  const Eigen::Array3d known = eigen.eigenvalues().array().max(0);
  const Eigen::Vector3d held = known / (1 + known * kFloorRad * kFloorRad);
  return eigen.eigenvectors() * held.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

VanishingDirectionTracker::RotationEstimate VanishingDirectionTracker::read(
    const Camera& camera, const LineView& view, const SO3& R_ref_cam_guess,
    double sigma_rad) const {
  // Lines for three unknowns; iterations at most.
  constexpr int kLeast = 3, kIterations = 10;
  RotationEstimate result;
  result.R_ref_cam = R_ref_cam_guess;
  const Evidence evidence = Evidence::of(camera, view, options_.noise);
  std::vector<std::pair<int, const Known*>> pointing;
  for (int i = 0; i < evidence.lines.size(); ++i)
    if (const auto of = direction_of_.find(evidence.id(i)); of != direction_of_.end())
      if (of->second >= 0)
        pointing.emplace_back(i, &directions_[static_cast<std::size_t>(of->second)]);
  result.lines = static_cast<int>(pointing.size());
  if (result.lines < kLeast) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      std::to_string(result.lines) + " lines of known direction");
    return result;
  }
  const double held = 1 / (sigma_rad * sigma_rad);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (const auto& [i, known] : pointing) {
      const Eigen::Vector3d v = result.R_ref_cam.inverse() * known->d_ref;
      const PointingError error = evidence.lines.error(i, v);
      const double w =
          evidence.lines.weight(i) * evidence.lines.robust_weight(error) / error.variance;
      // v = R^T d and R exp(x): v changes by v x x.
      const Eigen::RowVector3d J = error.J_sine_v * hat(v);
      H += w * J.transpose() * J;
      g += w * error.sine * J.transpose();
    }
    result.information = H;
    const Eigen::Vector3d off = (R_ref_cam_guess.inverse() * result.R_ref_cam).log();
    const Eigen::Vector3d step =
        -(H + held * Eigen::Matrix3d::Identity()).ldlt().solve(g + held * off);
    result.R_ref_cam = result.R_ref_cam.plus(step);
    if (step.norm() < 1e-8) break;
  }
  result.information = with_floor(result.information);
  result.outcome = Outcome::ok();
  return result;
}

std::vector<VanishingDirectionTracker::DirectionCluster> VanishingDirectionTracker::clusters()
    const {
  // Two lines determine a direction, the third one tests it.
  constexpr std::size_t kLeast = 3;
  std::vector<DirectionCluster> clusters;
  for (const Known& known : directions_) {
    // Planes with little rotation about a direction leave it undetermined along themselves.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(known.across,
                                                               Eigen::EigenvaluesOnly);
    const double own = 1 / std::sqrt(std::max(1e-12, eigen.eigenvalues()[1]));
    clusters.push_back({known.d_ref, std::hypot(own, kFloorRad), {}});
  }
  for (const auto& [id, direction] : direction_of_)
    if (direction >= 0) clusters[static_cast<std::size_t>(direction)].tracks.push_back(id);
  std::erase_if(clusters,
                [](const DirectionCluster& cluster) { return cluster.tracks.size() < kLeast; });
  return clusters;
}

/// Assigns every track of the view the direction that it points to; returns those that point to
/// none of them and never did.
LineView VanishingDirectionTracker::assign(const Evidence& evidence, const LineView& view,
                                           const SO3& R_ref_cam) {
  // Deviations at which a line joins a direction and at which it leaves it. Chosen.
  constexpr double kJoinSigmas = 2.5, kLeaveSigmas = 5;
  std::map<LineId, int> now;
  LineView left;
  for (int i = 0; i < evidence.lines.size(); ++i) {
    const LineId id = evidence.id(i);
    const auto before = direction_of_.find(id);
    const auto sigmas = [&](int k) {
      const PointingError e = evidence.lines.error(
          i, R_ref_cam.inverse() * directions_[static_cast<std::size_t>(k)].d_ref);
      return std::abs(e.sine) / std::sqrt(e.variance + kFloorRad * kFloorRad);
    };
    int direction = -1;
    if (before != direction_of_.end()) {
      direction = before->second;
      if (direction >= 0 && sigmas(direction) > kLeaveSigmas) direction = -1;
    } else {
      int rivals = 0;
      for (int k = 0; k < directions(); ++k) {
        if (sigmas(k) < kJoinSigmas) direction = k;
        rivals += sigmas(k) < 2 * kJoinSigmas;
      }
      if (rivals > 1) direction = -1;  // it points to two vanishing points
      if (rivals == 0) left[id] = view.at(id);
    }
    now[id] = direction;
  }
  direction_of_ = std::move(now);
  return left;
}

/// Adds the vanishing points of tracks without a direction as new directions.
void VanishingDirectionTracker::find_new(const Camera& camera, const LineView& left,
                                         const SO3& R_ref_cam, Random& random) {
  if (static_cast<int>(left.size()) < 2 * options_.min_segments) return;
  std::vector<LineSegment> segments;
  std::vector<LineId> ids;
  for (const auto& [id, line] : left) segments.push_back(line.segment), ids.push_back(id);
  const VanishingPoints found = find_vanishing_points(segments, camera, options_, random);
  const int first = directions();
  for (const VanishingPoint& point : found.points)
    directions_.push_back({R_ref_cam * point.direction});
  for (std::size_t i = 0; i < found.labels.size(); ++i)
    if (found.labels[i] >= 0) direction_of_[ids[i]] = first + found.labels[i];
}

/// Moves every direction to the intersection of the planes of its tracks, those of earlier views
/// with a decreasing weight.
void VanishingDirectionTracker::refine(const Evidence& evidence, const SO3& R_ref_cam) {
  // Weight of a frame on the next: a memory of about 30 frames. Chosen.
  constexpr double kForget = 0.97;
  for (Known& known : directions_) known.across *= kForget;
  for (int i = 0; i < evidence.lines.size(); ++i) {
    const int direction = direction_of_.at(evidence.id(i));
    if (direction < 0) continue;
    Known& known = directions_[static_cast<std::size_t>(direction)];
    const PointingError e = evidence.lines.error(i, R_ref_cam.inverse() * known.d_ref);
    // If the error is zero, its derivative is the normal of the plane up to a factor.
    const Eigen::Vector3d n = e.J_sine_v.norm() * (R_ref_cam * evidence.lines.normal(i));
    known.across +=
        evidence.lines.weight(i) * evidence.lines.robust_weight(e) / e.variance * n * n.transpose();
  }
  for (Known& known : directions_) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(known.across);
    if (!(eigen.eigenvalues()[1] > 1e-3 * eigen.eigenvalues()[2])) continue;
    const Eigen::Vector3d d = eigen.eigenvectors().col(0);
    if (std::abs(d.dot(known.d_ref)) > std::cos(0.05))
      known.d_ref = d.dot(known.d_ref) < 0 ? Eigen::Vector3d(-d) : d;
  }
}

void VanishingDirectionTracker::learn(const Camera& camera, const LineView& view,
                                      const SO3& R_ref_cam, Random& random) {
  const Evidence evidence = Evidence::of(camera, view, options_.noise);
  find_new(camera, assign(evidence, view, R_ref_cam), R_ref_cam, random);
  refine(evidence, R_ref_cam);
}

}  // namespace placegraph
