#pragma once
#include <limits>

namespace [[gnu::visibility("default")]] placegraph {

/// Residual radial distortion of images that are expected to be undistorted.
struct LensDistortion {
  double k1 = 0;  ///< first radial coefficient of OpenCV's model; 0 before the first estimate
  /// Standard deviation of k1; infinite before the first estimate.
  double sigma_k1 = std::numeric_limits<double>::infinity();
  /// Displacement of the tracks by k1 that no other motion or structure explains: root mean square
  /// in standard deviations of the tracks.
  double effect = 0;
  /// Number of stretches of motion, of equal weight, that k1 was estimated from.
  double stretches = 0;
};

}  // namespace placegraph
