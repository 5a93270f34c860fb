#pragma once
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>

// Observations of the points and lines of a sliding window by cameras. Other measurements:
// window_measurements.h.
namespace placegraph {

/// An observation of a landmark in a keyframe.
/// The inverse depth (1 / z in the camera frame) is from stereo (disparity / (f b)) or a depth
/// camera.
struct WindowObservation {
  KeyframeId keyframe;
  LandmarkId landmark;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double sigma_px = 1;
  std::optional<double> inverse_depth;  ///< [1/m]
  double sigma_inverse_depth = 1;       ///< standard deviation [1/m]
  /// Covariance of px [px^2] if the noise is anisotropic; replaces sigma_px.
  std::optional<Eigen::Matrix2d> covariance_px = std::nullopt;
  /// g of the plane g^T p_cam = 1 through the measured depths around px; zero: not known.
  Eigen::Vector3d surface_cam = Eigen::Vector3d::Zero();
};

/// An observed segment of a line landmark in a keyframe.
/// Its ends may be anywhere along the line.
struct LineObservation {
  KeyframeId keyframe;
  LineId line;
  Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
  double sigma_px = 1;  ///< standard deviation across the line

  /// The same line in a second camera at `second_in_cam` [m] in the keyframe's camera frame, with
  /// the same orientation and calibration: the right camera of a rectified pair, or a virtual
  /// camera computed from depths on the line.
  struct SecondCamera {
    Eigen::Vector3d second_in_cam = Eigen::Vector3d::Zero();
    Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
    double sigma_px = 1;
  };
  std::optional<SecondCamera> second = std::nullopt;
};

/// A point landmark on a plane landmark.
struct PlanePoint {
  PlaneId plane;
  LandmarkId landmark;
  double sigma_m = 1;  ///< unevenness of the plane
};

}  // namespace placegraph
