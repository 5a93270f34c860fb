#pragma once
#include <placegraph/graph/landmark.h>

#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a cue says of an image: one vector per cell of a grid laid over it, in whole numbers, so
/// that comparing is quick and memory small; their common scale means nothing.
struct CueGrid {
  int columns = 0, rows = 0, channels = 0;
  std::vector<std::int16_t> values;  ///< row after row, a cell's channels together
  /// Sum of the squared lengths of all cells above and left, (columns + 1) x (rows + 1).
  std::vector<std::int64_t> energy;
  bool empty() const { return values.empty(); }
};

/// CueGrid::energy of these values.
std::vector<std::int64_t> cell_energy(int columns, int rows, int channels,
                                      const std::vector<std::int16_t>& values);

/// An image in all cues (frontend/internal/places/place_view.h makes and compares them).
struct PlaceView {
  /// At scale 1 and, of a query, at 1 / zoom and zoom.
  std::vector<CueGrid> tiny, gradients;
  CueGrid colour;  ///< empty for a grey image: there is no colour cue
  CueGrid gabor;   ///< texture; empty unless it counts
  CueGrid coarse;  ///< the tiny image at half its columns, for a second look
  /// All grids pooled to a few cells, of unit length each and rounded to whole numbers: a first
  /// look at tens of thousands of views is a dot product.
  std::vector<std::int16_t> glance;
  std::vector<Feature> corners;
  bool empty() const { return glance.empty(); }  ///< none was made
};

}  // namespace placegraph
