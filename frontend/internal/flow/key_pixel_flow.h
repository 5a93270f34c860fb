#pragma once
#include <placegraph/frontend/internal/flow/flow_vector.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct KeyPixelFlowOptions {
  int max_key_pixels = 2000;  ///< the strongest
  double max_flow_px = 100;   ///< partners are sought no farther away
  double max_ratio = 0.8;     ///< distance of the best partner over that of the second
  double max_scale_ratio = 1.6;
  void check() const;
};
void visit(OptionVisitor& field, KeyPixelFlowOptions& options);

/// Sparse flow at key-pixels: extrema of intensity change in Gaussian-smoothed images, matched by
/// histograms of gradients (Lowe 2004), each the other's best partner among those of like size
/// within reach. Full vectors only, in the order of the first image's key-pixels; covariances from
/// their sizes: the larger the blob, the less sure its place. Images CV_8UC1; throws ArgumentError.
std::vector<FlowVector> key_pixel_flow(const Image& from, const Image& to,
                                       const KeyPixelFlowOptions& options);

}  // namespace placegraph
