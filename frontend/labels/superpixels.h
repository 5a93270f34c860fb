#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

struct SuperpixelOptions {
  int side_px = 10;   ///< approximate side of a superpixel
  double ruler = 20;  ///< compactness; larger is more compact
  int iterations = 5;
  void check() const;
};
void visit(OptionVisitor& field, SuperpixelOptions& options);

/// Two adjacent superpixels, a < b.
struct SuperpixelBorder {
  int a = 0, b = 0;
  /// Numbers of neighbouring pixels along the border: side by side (`b` to the right of `a` counts
  /// as `beside`, and so does the reverse), `a` above `b`, and `a` below `b`.
  int beside = 0, above = 0, below = 0;
  int length() const { return beside + above + below; }
};

/// Position and shape of a superpixel.
struct RegionShape {
  int area_px = 0;
  float u = 0, v = 0;                              ///< mean of its pixels
  int min_u = 0, max_u = 0, min_v = 0, max_v = 0;  ///< ends included
  float uu = 0, uv = 0, vv = 0;                    ///< central second moments [px^2]
};

/// Image divided into small connected regions of one colour.
struct Superpixels {
  static constexpr int kCoarse = 4;  ///< side of a pixel of `coarse` [pixels of the image]
  int count = 0, rows = 0, cols = 0;
  Image index;   ///< CV_32SC1, from 0 to count - 1
  Image coarse;  ///< every fourth pixel of the index image
  std::vector<RegionShape> shapes;
  std::vector<SuperpixelBorder> borders;  ///< all adjacent pairs, sorted by (a, b)
};

/// SLIC superpixels (Achanta et al. 2012) of a CV_8UC3 BGR image.
///
/// The same image gives the same superpixels. Throws ArgumentError for another type or an image
/// smaller than two superpixels.
Superpixels cut_superpixels(const Image& bgr, const SuperpixelOptions& options = {});

/// Superpixels of an index image (CV_32SC1, which contains every number from 0 to count - 1).
Superpixels superpixels_of_index(const Image& index, int count);

}  // namespace placegraph
