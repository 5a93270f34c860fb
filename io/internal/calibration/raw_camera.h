#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

/// A camera as its images come. Its lens may have the denominator of OpenCV's rational model,
/// (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6), which Camera has not: images
/// are undistorted before they are handed over.
struct RawCamera {
  RawCamera() = default;
  RawCamera(const Camera& without_denominator) : camera(without_denominator) {}  // NOLINT

  Camera camera;                        ///< the rest of it, if there is a denominator
  std::array<double, 3> denominator{};  ///< k4 k5 k6, of a radial-tangential lens only

  bool is_rational() const { return denominator != std::array<double, 3>{}; }
  /// As Camera::check.
  void check() const;
  /// In OpenCV's order: four of an equidistant lens, else five or eight.
  std::vector<double> coefficients() const;
  /// Distance from the principal point, in focal lengths, beyond which the radial part of a
  /// rational lens has no ray: it turns back there, or comes no further.
  double rational_reach() const;
};

/// A right eye as its images come, and where it is.
struct RightCamera {
  RawCamera raw;
  SE3 T_left_right;
};

/// Puts the coefficients of a radial-tangential model, in OpenCV's order, into a camera. Throws
/// ArgumentError unless there are four, five, eight, or more that are zero behind the eighth.
void set_radial_tangential(const std::vector<double>& coefficients, RawCamera& raw);

}  // namespace placegraph
