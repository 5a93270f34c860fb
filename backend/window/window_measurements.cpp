#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace placegraph {
namespace {

using Length = WindowFactor::Length;

bool is_positive(double x) { return std::isfinite(x) && x > 0; }

template <class Matrix>
bool is_symmetric(const Matrix& m) {
  return m.allFinite() && m.isApprox(m.transpose(), 1e-9);
}

/// Throws unless the information is symmetric, positive semi-definite and not zero.
template <class Matrix>
void require_information(const Matrix& information, const std::string& name) {
  require(is_symmetric(information), name + ": the information must be symmetric and finite");
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(information);
  const double least = eigen.eigenvalues()[0];
  const double largest = eigen.eigenvalues()[information.rows() - 1];
  require(largest > 0 && least >= -1e-9 * largest,
          name + ": the information must be positive semi-definite and not zero");
}

}  // namespace

WindowFactor window_factor(const DistanceObservation& d) {
  require(std::isfinite(d.distance_m) && d.distance_m >= 0 && is_positive(d.sigma_m),
          "sliding window: distance_m must be finite and not negative, sigma_m positive");
  return {std::make_shared<DistanceFactor>(d.distance_m, d.sigma_m),
          {keyframe_variable(d.from), keyframe_variable(d.to)},
          true,
          Length::kMeasured};
}

WindowFactor window_factor(const HeightObservation& h) {
  require(is_positive(h.height_m) && is_positive(h.sigma_m),
          "sliding window: height_m and sigma_m must be finite and positive");
  return {std::make_shared<HeightAbovePlaneFactor>(h.height_m, h.sigma_m),
          {keyframe_variable(h.keyframe), plane_variable(h.plane)},
          true,
          Length::kHeight};
}

WindowFactor window_factor(const PlaneObservation& o) {
  const Eigen::LLT<Eigen::Matrix3d> llt(o.information);
  require(is_symmetric(o.information) && llt.info() == Eigen::Success,
          "sliding window: plane " + to_string(o.plane) + " in keyframe " + to_string(o.keyframe) +
              ": the information must be symmetric, finite and positive definite");
  return {std::make_shared<PlaneObservationFactor>(o.plane_cam, llt.matrixU()),
          {keyframe_variable(o.keyframe), plane_variable(o.plane)},
          true,
          Length::kMeasured};
}

WindowFactor window_factor(const ManhattanObservation& o) {
  const std::string name = "sliding window: observation of Manhattan frame " +
                           to_string(o.manhattan_frame) + " in keyframe " + to_string(o.keyframe);
  require(o.R_cam_manhattan.matrix().allFinite(), name + ": the rotation must be finite");
  require_information(o.information, name);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(o.information);
  const Eigen::Matrix3d W =
      eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
  return {std::make_shared<AbsoluteRotationFactor>(o.R_cam_manhattan, W),
          {keyframe_variable(o.keyframe), manhattan_variable(o.manhattan_frame)},
          true,
          Length::kNone};
}

WindowFactor window_factor(const PosePrior& prior) {
  const std::string name = "sliding window: pose prior of keyframe " + to_string(prior.keyframe);
  require(prior.T_map_cam.matrix().allFinite(), name + ": the pose must be finite");
  require_information(prior.information, name);
  // A prior of the rotation alone has no scale.
  const bool rotation_only = prior.information.topRows<3>().isZero(0);
  return {std::make_shared<PosePriorFactor<SE3>>(prior.T_map_cam, whitening(prior.information)),
          {keyframe_variable(prior.keyframe)},
          false,
          rotation_only ? Length::kNone : Length::kPosition};
}

WindowFactor window_factor(const MotionObservation& motion) {
  const std::string name = "sliding window: motion from keyframe " + to_string(motion.from) +
                           " to " + to_string(motion.to);
  require(motion.T_from_to.matrix().allFinite(), name + ": the pose must be finite");
  require_information(motion.information, name);
  // A motion of deficient rank, e.g. a direction of translation, does not measure the scale.
  bool deficient = false;
  const Matrix6d W = whitening(motion.information, &deficient);
  return {std::make_shared<RelativePoseFactor<SE3>>(motion.T_from_to, W),
          {keyframe_variable(motion.from), keyframe_variable(motion.to)},
          false,
          deficient ? Length::kNone : Length::kMeasured};
}

namespace {

bool is_plane_observation(const WindowFactor& factor) {
  return dynamic_cast<const PlaneObservationFactor*>(factor.factor.get()) != nullptr;
}

}  // namespace

void add_distance(SlidingWindow& window, const DistanceObservation& distance) {
  window.add(window_factor(distance));
}

void add_height(SlidingWindow& window, const HeightObservation& height) {
  window.add(window_factor(height));
}

void add_plane_observation(SlidingWindow& window, const PlaneObservation& observation) {
  const WindowFactor factor = window_factor(observation);
  for (const WindowFactor& other : window.factors())
    require(!is_plane_observation(other) || other.variables != factor.variables,
            "sliding window: plane " + to_string(observation.plane) + " in keyframe " +
                to_string(observation.keyframe) + " is there already");
  window.add(factor);
}

void add_manhattan_observation(SlidingWindow& window, const ManhattanObservation& observation) {
  window.add(window_factor(observation));
}

void add_pose_prior(SlidingWindow& window, const PosePrior& prior) {
  window.add(window_factor(prior));
}

void add_motion(SlidingWindow& window, const MotionObservation& motion) {
  window.add(window_factor(motion));
}

std::vector<WindowFactor> plane_observations(const SlidingWindow& window) {
  std::vector<WindowFactor> result;
  std::copy_if(window.factors().begin(), window.factors().end(), std::back_inserter(result),
               is_plane_observation);
  return result;
}

}  // namespace placegraph
