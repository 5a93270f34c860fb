#pragma once
#include <placegraph/frontend/internal/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// The image itself, shrunk to `columns` cells (their rows follow its shape) at `scale`: lightness
/// and, of a BGR image, the two colour axes of CIELAB, each less its mean over the image and
/// divided by its deviation, so that brightness, contrast and a cast play no part. Images of one
/// and three channels, 8 bits (ArgumentError otherwise).
CueGrid tiny_image_cue(const Image& image, int columns, double scale = 1);

/// Cells of a grid over an image at a scale, whole multiples of `multiple`, at least one.
struct GridSize {
  int columns = 0, rows = 0;
};
GridSize grid_size(const Image& image, int columns, double scale, int multiple);

}  // namespace placegraph
