#pragma once
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Shrinks the image itself to `columns` cells (the rows follow from its shape) at `scale`.
///
/// The channels are lightness and, for a BGR image, the two colour axes of CIELAB, each minus its
/// mean over the image and divided by its deviation. This removes brightness, contrast and a colour
/// cast. Images of one or three channels, 8 bits (ArgumentError otherwise).
CueGrid tiny_image_cue(const Image& image, int columns, double scale = 1);

/// Number of cells of a grid over an image at a scale, whole multiples of `multiple`, at least one.
struct GridSize {
  int columns = 0, rows = 0;
};
GridSize grid_size(const Image& image, int columns, double scale, int multiple);

}  // namespace placegraph
