#pragma once
#include <placegraph/frontend/internal/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct GradientLayoutOptions {
  int columns = 12;  ///< cells over the image at scale 1; rows follow its shape
  int cell_px = 8;
  int orientations = 9;  ///< of [0, 180) deg
};

/// The layout of edges: histograms of gradient orientation (Dalal & Triggs 2005), each gradient
/// counted by its magnitude in the two nearest orientations and the four nearest cells, each cell
/// divided by the length of its neighbourhood of 3x3 cells, so that contrast and light play no
/// part. Grey image of 8 bits (ArgumentError otherwise), looked at at `scale`.
CueGrid gradient_layout_cue(const Image& grey, const GradientLayoutOptions& options = {},
                            double scale = 1);

}  // namespace placegraph
