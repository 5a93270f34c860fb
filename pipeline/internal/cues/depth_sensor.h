#pragma once
#include <placegraph/frontend/internal/features/rectification.h>
#include <placegraph/frontend/internal/features/stereo_matcher.h>
#include <placegraph/frontend/internal/planes/inverse_depth_plane.h>
#include <placegraph/graph/image/frame.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Measures the depth of pixels of a frame: from the right image of a stereo camera, or from a
/// depth image. A monocular camera measures none.
class DepthSensor {
 public:
  DepthSensor(const Calibration& calibration, const StereoMatcherOptions& stereo)
      : calibration_(calibration), stereo_(stereo) {}

  /// One entry per pixel of `px` [px, left image]; nothing where no depth is found. Of points far
  /// away, noise can make the inverse depth of a stereo camera negative: that is a measurement like
  /// any other. `expected_px`: where the disparity is sought, as the cameras show it (the
  /// rectification error included), one per pixel or empty; it does not matter to a depth image.
  std::vector<std::optional<InverseDepth>> measure(
      const Frame& frame, const RectificationError& rectification,
      const std::vector<Eigen::Vector2f>& px,
      const std::vector<std::optional<double>>& expected_px = {}) const;
  /// The disparity [px], as the cameras show it, of a point at `point_cam` [m] in front of the left
  /// camera; nothing behind it or without a baseline.
  std::optional<double> disparity_px(const Eigen::Vector3d& point_cam,
                                     const RectificationError& rectification) const;
  /// The same for pixels of which an inverse depth [1/m] is expected, one per pixel of `px`; it may
  /// be negative. Empty without a baseline, and if `inverse_depths` is.
  std::vector<std::optional<double>> disparities_px(const std::vector<Eigen::Vector2f>& px,
                                                    const std::vector<double>& inverse_depths,
                                                    const RectificationError& rectification) const;

 private:
  Calibration calibration_;
  StereoMatcherOptions stereo_;
};

}  // namespace placegraph
