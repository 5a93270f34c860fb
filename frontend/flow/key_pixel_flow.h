#pragma once
#include <placegraph/frontend/flow/flow_options.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// Sparse flow at key-pixels, extrema of intensity change in Gaussian-smoothed images.
///
/// They are matched by histograms of gradients (Lowe 2004), each the other's best partner among
/// those of similar size within max_flow_px. Full vectors only, in the order of the first image's
/// key-pixels. Covariances are from their sizes: the larger the blob, the less certain its
/// position. Images CV_8UC1; throws ArgumentError.
std::vector<FlowVector> key_pixel_flow(const Image& from, const Image& to,
                                       const KeyPixelFlowOptions& options);

}  // namespace placegraph
