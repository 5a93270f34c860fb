#pragma once
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

struct GradientLayoutOptions {
  /// Number of cells across the image at scale 1; the rows follow from its shape.
  int columns = 12;
  int cell_px = 8;
  int orientations = 9;  ///< number of orientations in [0, 180) deg
};

/// Histograms of gradient_layout_cue before they are rounded.
///
/// Row by row, `orientations` values a cell, each from 0 to 1.
std::vector<float> gradient_layout(const Image& grey, const GradientLayoutOptions& options = {},
                                   double scale = 1);

/// Layout of edges: histograms of gradient orientation (Dalal & Triggs 2005).
///
/// Each gradient counts by its magnitude in the two nearest orientations and the four nearest
/// cells; each cell is divided by the length of its neighbourhood of 3x3 cells, which removes
/// contrast and illumination. Grey image, 8 bits (ArgumentError otherwise), described at `scale`.
CueGrid gradient_layout_cue(const Image& grey, const GradientLayoutOptions& options = {},
                            double scale = 1);

}  // namespace placegraph
