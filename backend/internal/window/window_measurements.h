#pragma once
#include <placegraph/backend/internal/window/window_factor.h>
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <cstdint>

// What a sliding window can be told beside what cameras see of points and lines
// (window_observations.h): each struct is a measurement between its variables, and window_factor()
// makes the factor of it. A new kind needs neither: it can be added as a WindowFactor at once.
namespace placegraph {

class SlidingWindow;

/// A metric length: |t| of T_from_to, as the ground plane under a camera of known height gives it.
struct DistanceObservation {
  KeyframeId from, to;
  double distance_m = 0;
  double sigma_m = 1;
};

/// A camera at a known height above a plane landmark, as above the ground a vehicle drives on.
struct HeightObservation {
  KeyframeId keyframe;
  PlaneId plane;
  double height_m = 0;
  double sigma_m = 1;
};

/// A plane landmark as a keyframe measures it, by its depth image: error log(q_measured^-1 q_cam),
/// see PlaneObservationFactor.
struct PlaneObservation {
  KeyframeId keyframe;
  PlaneId plane;
  Plane3 plane_cam;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of its tangent, of full rank
};

/// A rectangular world, a rotation of the window, as a keyframe sees it: error
/// log(R_map_manhattan^-1 R_map_cam R_cam_manhattan), see AbsoluteRotationFactor.
struct ManhattanObservation {
  KeyframeId keyframe;
  ManhattanFrameId manhattan_frame;
  SO3 R_cam_manhattan;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< right tangent, of any rank
};

/// What is known of a keyframe's pose from elsewhere: error log(T_map_cam_measured^-1 T_map_cam).
struct PosePrior {
  KeyframeId keyframe;
  SE3 T_map_cam;
  Matrix6d information = Matrix6d::Identity();  ///< of any rank
};

/// A motion between two keyframes that was measured apart from the landmarks of the window, as by
/// aligning grey values: error log(T_from_to_measured^-1 T_map_from^-1 T_map_to). Not robust: its
/// owner judges it.
struct MotionObservation {
  KeyframeId from, to;
  SE3 T_from_to;
  Matrix6d information = Matrix6d::Identity();  ///< right tangent of T_from_to; of any rank
};

/// The factors of measurements. Throw ArgumentError, which names the measurement, where a number is
/// not finite, a standard deviation not positive or an information not symmetric and positive
/// semi-definite. A measured plane, a distance, a height and a sighting of a world are robust, a
/// prior and a motion are not.
WindowFactor window_factor(const DistanceObservation& distance);
WindowFactor window_factor(const HeightObservation& height);
WindowFactor window_factor(const PlaneObservation& observation);
WindowFactor window_factor(const ManhattanObservation& observation);
WindowFactor window_factor(const PosePrior& prior);
WindowFactor window_factor(const MotionObservation& motion);

/// The same at once into a window. Throw ArgumentError if a variable is not in it. A plane can be
/// measured once in a keyframe.
void add_distance(SlidingWindow& window, const DistanceObservation& distance);
void add_height(SlidingWindow& window, const HeightObservation& height);
void add_plane_observation(SlidingWindow& window, const PlaneObservation& observation);
void add_manhattan_observation(SlidingWindow& window, const ManhattanObservation& observation);
void add_pose_prior(SlidingWindow& window, const PosePrior& prior);
void add_motion(SlidingWindow& window, const MotionObservation& motion);

/// The factors of measured planes, each between a keyframe and a plane, in the order in which they
/// came.
std::vector<WindowFactor> plane_observations(const SlidingWindow& window);

}  // namespace placegraph
