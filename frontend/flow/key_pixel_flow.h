#pragma once
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

/// Options of the flow at key-pixels.
struct KeyPixelFlowOptions {
  int max_key_pixels = 2000;  ///< maximum number of key-pixels per image, the strongest ones
  double max_flow_px = 100;   ///< maximum distance of partners
  double max_ratio = 0.8;  ///< maximum ratio of the descriptor distances of the two best partners
  double max_scale_ratio = 1.6;  ///< maximum ratio of the sizes of partners
  void check() const;
};
void visit(OptionVisitor& field, KeyPixelFlowOptions& options);

/// Sparse flow at key-pixels, extrema of intensity change in Gaussian-smoothed images.
///
/// They are matched by histograms of gradients (Lowe 2004), each the other's best partner among
/// those of similar size within max_flow_px. Full vectors only, in the order of the first image's
/// key-pixels. Covariances are from their sizes: the larger the blob, the less certain its
/// position. Images CV_8UC1; throws ArgumentError.
std::vector<FlowVector> key_pixel_flow(const Image& from, const Image& to,
                                       const KeyPixelFlowOptions& options);

}  // namespace placegraph
