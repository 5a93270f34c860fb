#pragma once
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <optional>

namespace placegraph {

using SquareCorners = std::array<Eigen::Vector2d, 4>;

/// A dark square measured in an image.
struct SquareFit {
  SquareCorners corners_px;  ///< in the order of those given
  /// Of the corners together, [x0 y0 x1 y1 ...]: neighbours share a side, so their errors do too.
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double contrast = 0;  ///< least of the sides, grey levels
};

/// Fits the four sides of a dark square on a bright ground to the grey values beside them and
/// intersects them. A side is a step between two levels, each linear along the side, smoothed by a
/// Gaussian of unknown width: seven numbers by least squares over the pixels themselves, so that
/// blur and the size of pixels do not bend it. Covariance: that of the least squares with the
/// variance of its residuals. `border_share` is the width of the dark border over the side: pixels
/// farther inside are not looked at. With `lens` the sides are straight in the image without
/// distortion. Nothing where a side has no pixels, too little contrast, or no step near
/// the one expected.
std::optional<SquareFit> fit_square(const Image& grey, const SquareCorners& expected_px,
                                    double border_share, const SquareFitOptions& options,
                                    const Camera* lens = nullptr);

}  // namespace placegraph
