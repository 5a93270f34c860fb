#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// The camera of the raw images. Its lens may have the denominator of OpenCV's rational model, (1 +
/// k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6), which Camera does not have: images
/// are undistorted before they are returned.
struct RawCamera {
  RawCamera() = default;
  RawCamera(const Camera& without_denominator) : camera(without_denominator) {}  // NOLINT

  Camera camera;                        ///< the camera without the denominator
  std::array<double, 3> denominator{};  ///< k4 k5 k6; only for a radial-tangential lens

  bool is_rational() const { return denominator != std::array<double, 3>{}; }
  /// As Camera::check.
  void check() const;
  /// Coefficients in OpenCV's order: four for an equidistant lens, else five or eight.
  std::vector<double> coefficients() const;
  /// Distance from the principal point, in focal lengths, beyond which the radial part of a
  /// rational lens has no ray: the radius decreases there, or has reached its limit.
  double rational_reach() const;
};

/// The right camera of the raw images, and its pose.
struct RightCamera {
  RawCamera raw;
  SE3 T_left_right;
};

/// Sets the coefficients of a radial-tangential model, in OpenCV's order, of a camera. Throws
/// ArgumentError unless there are four, five, eight, or more that are zero after the eighth.
void set_radial_tangential(const std::vector<double>& coefficients, RawCamera& raw);

}  // namespace placegraph
