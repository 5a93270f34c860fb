#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

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

}  // namespace placegraph
