#pragma once
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>

// What cameras see of the points and lines of a sliding window. All else that it is told:
// window_measurements.h.
namespace placegraph {

/// A landmark seen in a keyframe. The inverse depth (1 / z in the camera frame) comes from stereo
/// (disparity / (f b)) or a depth camera.
struct WindowObservation {
  KeyframeId keyframe;
  LandmarkId landmark;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double sigma_px = 1;
  std::optional<double> inverse_depth;  ///< [1/m]
  double sigma_inverse_depth = 1;       ///< [1/m]
  /// Of px, where it is not alike in all directions: takes the place of sigma_px.
  std::optional<Eigen::Matrix2d> covariance_px = std::nullopt;
};

/// A segment of a line landmark seen in a keyframe; its ends may lie anywhere along the line.
struct LineObservation {
  KeyframeId keyframe;
  LineId line;
  Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
  double sigma_px = 1;  ///< across the line

  /// The same line in a second eye at `second_in_cam` [m] in the keyframe's camera, of its
  /// orientation and calibration: the right eye of a rectified pair, or one made up from depths on
  /// the line.
  struct SecondCamera {
    Eigen::Vector3d second_in_cam = Eigen::Vector3d::Zero();
    Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
    double sigma_px = 1;
  };
  std::optional<SecondCamera> second = std::nullopt;
};

/// A point landmark that lies on a plane landmark.
struct PlanePoint {
  PlaneId plane;
  LandmarkId landmark;
  double sigma_m = 1;  ///< how uneven the plane is
};

}  // namespace placegraph
