#pragma once
#include <placegraph/graph/measurements/landmark.h>

#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The descriptor of an image by one cue: one vector for each cell of a grid laid over it.
/// Integers make the comparison fast and save memory; their common scale is arbitrary.
struct CueGrid {
  int columns = 0, rows = 0, channels = 0;  ///< size of the grid; channels: size of a cell's vector
  std::vector<std::int16_t> values;         ///< row after row, a cell's channels together
  /// Integral image of the squared lengths of the cells' vectors, (columns + 1) x (rows + 1).
  std::vector<std::int64_t> energy;
  /// Whether the cue was not computed.
  bool empty() const { return values.empty(); }
};

/// The integral image CueGrid::energy of these values, row after row.
/// Throws ArgumentError unless there are columns * rows * channels values.
std::vector<std::int64_t> cell_energy(int columns, int rows, int channels,
                                      const std::vector<std::int16_t>& values);

/// An image's descriptors in all cues of place recognition.
struct PlaceView {
  /// Small image and gradients, at scale 1 and, for a query, also at 1 / zoom and zoom.
  std::vector<CueGrid> tiny, gradients;
  CueGrid colour;  ///< empty for a grey image: there is no colour cue
  CueGrid gabor;   ///< texture; empty if the cue has weight zero
  CueGrid coarse;  ///< the tiny image at half its columns, for the second of three comparisons
  /// Colour, coarse and gradients pooled to a few cells, each of unit length and rounded to
  /// integers: the first comparison, with tens of thousands of images, is a dot product.
  std::vector<std::int16_t> thumbnail;
  std::vector<Feature> corners;  ///< for the cue that counts agreeing features
  /// Whether no descriptor was computed.
  bool empty() const { return thumbnail.empty(); }
};

}  // namespace placegraph
