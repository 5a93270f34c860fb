#pragma once
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/planes/inverse_depth_plane.h>
#include <placegraph/graph/image/frame.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Measures the depth of pixels of a frame from the right image of a stereo camera, or from a depth
/// image. A monocular camera provides no measurement.
class DepthSensor {
 public:
  DepthSensor(const Calibration& calibration, const StereoMatcherOptions& stereo)
      : calibration_(calibration), stereo_(stereo) {}

  /// Measures one entry per pixel of `px` [px, left image]; nothing where no depth is found. For
  /// distant points, noise can make the inverse depth of a stereo camera negative; such a
  /// measurement is valid. `expected_px`: disparity at which the search starts, as observed by the
  /// cameras (including the rectification error), one per pixel or empty; not used for a depth
  /// image.
  std::vector<std::optional<MeasuredInverseDepth>> measure(
      const Frame& frame, const RectificationError& rectification,
      const std::vector<Eigen::Vector2f>& px,
      const std::vector<std::optional<double>>& expected_px = {}) const;
  /// The same from the depth image, which `depth` took, with the surfaces around the pixels;
  /// nothing without one.
  std::vector<std::optional<MeasuredInverseDepth>> measure_surfaces(
      const Frame& frame, const DepthCamera& depth, const std::vector<Eigen::Vector2f>& px) const;
  /// Disparity [px], as observed by the cameras, of a point at `point_cam` [m] in front of the left
  /// camera; nothing behind it or without a baseline.
  std::optional<double> disparity_px(const Eigen::Vector3d& point_cam,
                                     const RectificationError& rectification) const;
  /// The same for pixels with an expected inverse depth [1/m], one per pixel of `px`; it may be
  /// negative. Empty without a baseline, and if `inverse_depths` is empty.
  std::vector<std::optional<double>> disparities_px(const std::vector<Eigen::Vector2f>& px,
                                                    const std::vector<double>& inverse_depths,
                                                    const RectificationError& rectification) const;

 private:
  Calibration calibration_;
  StereoMatcherOptions stereo_;
};

}  // namespace placegraph
