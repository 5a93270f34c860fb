#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <array>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// The lens distortion model, applied to normalized coordinates [x/z, y/z].
enum class Distortion {
  kNone,              ///< pinhole, or an undistorted image
  kRadialTangential,  ///< k1 k2 p1 p2 k3 (Brown 1966; OpenCV's order)
  kEquidistant,       ///< k1 k2 k3 k4 (Kannala & Brandt 2006; OpenCV's fisheye)
};

/// A pinhole camera: x right, y down, z forward; pixel centres at integer coordinates.
struct Camera {
  int width = 0, height = 0;                  ///< size of the image [px]
  double fx = 0, fy = 0, cx = 0, cy = 0;      ///< focal lengths and principal point [px]
  Distortion distortion = Distortion::kNone;  ///< model of the lens
  /// Coefficients in the order of the distortion model; the rest are 0.
  std::array<double, 5> coefficients{};

  /// Throws ArgumentError naming the field that is not finite or not positive where it must be.
  void check() const;

  /// The calibration matrix [fx 0 cx; 0 fy cy; 0 0 1], without distortion.
  Eigen::Matrix3d K() const;
  /// The pixel of a point in the camera frame [m], which may be outside the image.
  /// Nothing if the point is behind the camera (z <= 0) or beyond the angle up to which the
  /// distortion model is monotonic. `J_px_cam`, if given, receives the 2x3 derivative.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_cam,
                                         Eigen::Matrix<double, 2, 3>* J_px_cam = nullptr) const;
  /// The viewing ray of a pixel in the camera frame, scaled to z = 1.
  /// Distortion is inverted by Newton iteration to 1e-10 in normalized coordinates; nothing where
  /// that does not converge.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// Whether the pixel is at least `border_px` inside the image.
  bool contains(const Eigen::Vector2d& px, double border_px = 0) const {
    return px[0] >= border_px && px[1] >= border_px && px[0] <= width - 1 - border_px &&
           px[1] <= height - 1 - border_px;
  }
};

/// The depth sensor of an RGB-D camera; its images need not be registered to the colour's.
struct DepthCamera {
  Camera camera;               ///< intrinsics of the depth images
  SE3 T_cam_depth;             ///< maps coordinates of the depth camera to the colour camera's
  double sigma_at_1m = 0.005;  ///< depth noise [m] at 1 m; grows with the square of the depth
};

/// The images of a frame: one image, a rectified stereo pair, or an image with its depth.
enum class Sensor { kMono, kStereo, kRgbd };

/// Calibration of the sensors; the frame of the left camera is "cam".
struct Calibration {
  Camera camera;  ///< intrinsics of the left or only camera, for the images that are passed in
  /// Baseline of a rectified stereo pair with these intrinsics; 0: no stereo.
  double baseline_m = 0;
  std::optional<DepthCamera> depth;       ///< depth camera; present if frames have a depth image
  std::optional<double> camera_height_m;  ///< height of the camera above the ground [m]

  void check() const;
};

}  // namespace placegraph
