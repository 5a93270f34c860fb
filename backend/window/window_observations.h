#pragma once
#include <placegraph/graph/geometry/plane3.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>

// What a sliding window is told: each struct is a measurement of its variables.
namespace placegraph {

/// A landmark seen in a keyframe. The inverse depth (1 / z in the camera frame) comes from stereo
/// (disparity / (f b)) or a depth camera.
struct WindowObservation {
  std::int64_t keyframe = 0;
  std::int64_t landmark = 0;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double sigma_px = 1;
  std::optional<double> inverse_depth;  ///< [1/m]
  double sigma_inverse_depth = 1;       ///< [1/m]
  /// Of px, where it is not alike in all directions: takes the place of sigma_px.
  std::optional<Eigen::Matrix2d> covariance_px = std::nullopt;
};

/// A metric length: |t| of T_from_to, as the ground plane under a camera of known height gives it.
struct DistanceObservation {
  std::int64_t from = 0, to = 0;
  double distance_m = 0;
  double sigma_m = 1;
};

/// A segment of a line landmark seen in a keyframe; its ends may lie anywhere along the line.
struct LineObservation {
  std::int64_t keyframe = 0;
  std::int64_t line = 0;
  Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
  double sigma_px = 1;  ///< across the line

  /// The same line in a second eye at `eye_cam` [m] in the keyframe's camera, of its orientation
  /// and calibration: the right eye of a rectified pair, or one made up from depths on the line.
  struct SecondEye {
    Eigen::Vector3d eye_cam = Eigen::Vector3d::Zero();
    Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
    double sigma_px = 1;
  };
  std::optional<SecondEye> second = std::nullopt;
};

/// A camera at a known height above a plane landmark, as above the ground a vehicle drives on.
struct HeightObservation {
  std::int64_t keyframe = 0;
  std::int64_t plane = 0;
  double height_m = 0;
  double sigma_m = 1;
};

/// A plane landmark as a keyframe measures it, by its depth image: error log(q_measured^-1 q_cam),
/// see PlaneObservationFactor.
struct PlaneObservation {
  std::int64_t keyframe = 0;
  std::int64_t plane = 0;
  Plane3 plane_cam;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of its tangent, of full rank
};

/// A point landmark that lies on a plane landmark.
struct PlanePoint {
  std::int64_t plane = 0;
  std::int64_t landmark = 0;
  double sigma_m = 1;  ///< how uneven the plane is
};

/// A rectangular world, a rotation of the window, as a keyframe sees it: error
/// log(R_map_world^-1 R_map_cam R_cam_world), see AbsoluteRotationFactor.
struct WorldObservation {
  std::int64_t keyframe = 0;
  std::int64_t world = 0;
  SO3 R_cam_world;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< right tangent, of any rank
};

/// What is known of a keyframe's pose from elsewhere: error log(T_map_cam_measured^-1 T_map_cam).
struct PosePrior {
  std::int64_t keyframe = 0;
  SE3 T_map_cam;
  Matrix6d information = Matrix6d::Identity();  ///< of any rank
};

/// A motion between two keyframes that was measured apart from the landmarks of the window, as by
/// aligning grey values: error log(T_from_to_measured^-1 T_map_from^-1 T_map_to). Not robust: its
/// owner judges it.
struct MotionObservation {
  std::int64_t from = 0, to = 0;
  SE3 T_from_to;
  Matrix6d information = Matrix6d::Identity();  ///< right tangent of T_from_to; of any rank
};

}  // namespace placegraph
