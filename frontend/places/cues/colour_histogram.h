#pragma once
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct ColourHistogramOptions {
  int cells = 4;  ///< number of columns and of rows, for any shape of the image
  int hues = 16, saturations = 4, values = 4;
};

/// Histograms of hue, saturation and value in the cells of a grid.
///
/// A pixel counts for the two nearest bins of each and for the four nearest cells, by its distance.
/// A cell's histogram sums to one and its root is taken, so that the cosine of two is their
/// Bhattacharyya coefficient. `bgr`: BGR, 8 bits (ArgumentError otherwise): a grey image does not
/// have this cue.
CueGrid colour_histogram_cue(const Image& bgr, const ColourHistogramOptions& options = {});

}  // namespace placegraph
