#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Displacements from one image to the next (CV_8UC1, of one size).
///
/// CV_32FC2, (du, dv) in pixels, NaN where the method has no result or only normal flow. Methods
/// that measure points have NaN between those of the grid (or between key-pixels). Throws
/// ArgumentError.
Image optical_flow(const Image& from, const Image& to, const FlowOptions& options);

/// Flow by image interpolation (Srinivasan 1994) at given points.
///
/// One vector for each of `points`, at the pixel nearest to it; none where the texture leaves a
/// direction undetermined, the patch leaves the image, or the residual is too large. Images
/// CV_8UC1, of one size; throws ArgumentError.
std::vector<FlowVector> interpolation_flow(const Image& from, const Image& to,
                                           const std::vector<Eigen::Vector2d>& points,
                                           const InterpolationFlowOptions& options);

/// Pyramidal Lucas-Kanade flow (Lucas & Kanade 1981; Bouguet 2000) at given points.
///
/// From one image to the next (CV_8UC1, of one size), one vector for each of `points` (pixels of
/// the first). A window whose gradient matrix has two eigenvalues above the threshold has a full
/// flow, one with one such eigenvalue a normal flow, any other none. A point that leaves the image
/// has none, nor has a full flow that fails the forward-backward check. Covariances are those of
/// least squares, from the residual's variance, corrected for the correlation of neighbouring
/// pixels by smoothing. Windows may extend beyond the sides of the first image: pixels outside
/// count as without gradient. Throws ArgumentError.
std::vector<FlowVector> lucas_kanade(const Image& from, const Image& to,
                                     const std::vector<Eigen::Vector2d>& points,
                                     const LucasKanadeOptions& options);

/// Sparse flow at key-pixels, extrema of intensity change in Gaussian-smoothed images.
///
/// They are matched by histograms of gradients (Lowe 2004), each the other's best partner among
/// those of similar size within max_flow_px. Full vectors only, in the order of the first image's
/// key-pixels. Covariances are from their sizes: the larger the blob, the less certain its
/// position. Images CV_8UC1; throws ArgumentError.
std::vector<FlowVector> key_pixel_flow(const Image& from, const Image& to,
                                       const KeyPixelFlowOptions& options);

}  // namespace placegraph
