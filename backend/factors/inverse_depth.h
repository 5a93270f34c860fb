#pragma once
#include <Eigen/Core>

namespace [[gnu::visibility("default")]] placegraph {

/// Measured inverse depth of a map point in a camera, in standard deviations:
///
///   r = [(1/z - observed) / sigma, 0],   [x y z] = p_cam
///   A = d r / d p_cam = [0, 0, -1/(z^2 sigma); 0, 0, 0]
///
/// The second row is always zero: if all residuals of points have two rows, Ceres eliminates the
/// points by its fixed-size code (2 rows, 3 and 6 columns), which is several times faster.
struct InverseDepth {
  double observed;       ///< measured inverse depth [1/m]
  double inverse_sigma;  ///< 1 / standard deviation of the inverse depth [m]

  /// Measured inverse depth and its standard deviation [1/m], which must be positive.
  InverseDepth(double inverse_depth, double sigma)
      : observed(inverse_depth), inverse_sigma(1.0 / sigma) {}

  static constexpr int kRows = 2;  ///< rows of the residual
  /// r, as above; `p_cam` must be projectable, see PointInCamera.
  Eigen::Vector2d residual(const Eigen::Vector3d& p_cam) const {
    return {(1.0 / p_cam[2] - observed) * inverse_sigma, 0.0};
  }
  /// A, as above.
  Eigen::Matrix<double, 2, 3> derivative(const Eigen::Vector3d& p_cam) const {
    Eigen::Matrix<double, 2, 3> A = Eigen::Matrix<double, 2, 3>::Zero();
    A(0, 2) = -inverse_sigma / (p_cam[2] * p_cam[2]);
    return A;
  }
};

}  // namespace placegraph
