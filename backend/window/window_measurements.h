#pragma once
#include <placegraph/backend/window/window_factor.h>
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <cstdint>

// Measurements of a sliding window, except the observations of points and lines
// (window_observations.h). Each struct is a measurement between its variables, and window_factor()
// makes its factor. A new kind of measurement needs neither: it can be added directly as a
// WindowFactor.
namespace placegraph {

class SlidingWindow;

/// A metric length |t| of T_from_to, e.g. by the ground plane under a camera of known height.
struct DistanceObservation {
  KeyframeId from, to;
  double distance_m = 0;
  double sigma_m = 1;
};

/// A known height of a camera above a plane landmark, e.g. above the ground under a vehicle.
struct HeightObservation {
  KeyframeId keyframe;
  PlaneId plane;
  double height_m = 0;
  double sigma_m = 1;
};

/// A plane landmark measured by a keyframe's depth image.
/// Error log(q_measured^-1 q_cam), see PlaneObservationFactor.
struct PlaneObservation {
  KeyframeId keyframe;
  PlaneId plane;
  Plane3 plane_cam;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< tangent, full rank
};

/// A Manhattan frame, a rotation of the window, observed by a keyframe.
/// Error log(R_map_manhattan^-1 R_map_cam R_cam_manhattan), see AbsoluteRotationFactor.
struct ManhattanObservation {
  KeyframeId keyframe;
  ManhattanFrameId manhattan_frame;
  SO3 R_cam_manhattan;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< right tangent, of any rank
};

/// A prior of a keyframe's pose from another source.
/// Error log(T_map_cam_measured^-1 T_map_cam).
struct PosePrior {
  KeyframeId keyframe;
  SE3 T_map_cam;
  Matrix6d information = Matrix6d::Identity();  ///< right tangent, any rank
};

/// A motion between two keyframes, measured independently of the window's landmarks.
/// For example by direct alignment. Error log(T_from_to_measured^-1 T_map_from^-1 T_map_to).
/// Without robust kernel: the caller tests the measurement.
struct MotionObservation {
  KeyframeId from, to;
  SE3 T_from_to;
  Matrix6d information = Matrix6d::Identity();  ///< right tangent of T_from_to, any rank
};

/// The factors of measurements.
/// Throw ArgumentError, which names the measurement, if a number is not finite, a standard
/// deviation not positive or an information not symmetric and positive semi-definite. A measured
/// plane, a distance, a height and an observation of a Manhattan frame have a robust kernel, a
/// prior and a motion have none.
WindowFactor window_factor(const DistanceObservation& distance);
WindowFactor window_factor(const HeightObservation& height);
WindowFactor window_factor(const PlaneObservation& observation);
WindowFactor window_factor(const ManhattanObservation& observation);
WindowFactor window_factor(const PosePrior& prior);
WindowFactor window_factor(const MotionObservation& motion);

/// Add the factors of measurements to a window.
/// Throw ArgumentError if a variable is not in it. A plane can be measured once in a keyframe.
void add_distance(SlidingWindow& window, const DistanceObservation& distance);
void add_height(SlidingWindow& window, const HeightObservation& height);
void add_plane_observation(SlidingWindow& window, const PlaneObservation& observation);
void add_manhattan_observation(SlidingWindow& window, const ManhattanObservation& observation);
void add_pose_prior(SlidingWindow& window, const PosePrior& prior);
void add_motion(SlidingWindow& window, const MotionObservation& motion);

/// The factors of measured planes, in the order in which they were added.
/// Each is between a keyframe and a plane.
std::vector<WindowFactor> plane_observations(const SlidingWindow& window);

}  // namespace placegraph
