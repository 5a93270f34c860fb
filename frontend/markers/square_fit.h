#pragma once
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <optional>

namespace placegraph {

/// A dark square measured in an image.
struct SquareFit {
  SquareCorners corners_px;  ///< in the order of the expected ones
  /// Joint covariance of the corners, [x0 y0 x1 y1 ...]; neighbours share a side, so their errors
  /// are correlated.
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double contrast = 0;  ///< least contrast of the sides [grey levels]
};

/// Fits the four sides of a dark square on a bright background and intersects them.
///
/// A side is a step between two grey levels, each linear along the side, smoothed by a Gaussian of
/// unknown width: seven parameters by least squares over the pixels near the side, so that blur and
/// the size of pixels do not bias it. The covariance is that of the least squares with the variance
/// of its residuals. `border_share` is the width of the dark border over the side: pixels farther
/// inside are not used. With `lens` the sides are straight in the undistorted image. Nothing if a
/// side has no pixels, too little contrast, or no step near the expected one.
std::optional<SquareFit> fit_square(const Image& grey, const SquareCorners& expected_px,
                                    double border_share, const SquareFitOptions& options,
                                    const Camera* lens = nullptr);

}  // namespace placegraph
