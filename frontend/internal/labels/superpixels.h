#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <vector>

namespace placegraph {

struct SuperpixelOptions {
  int side_px = 10;   ///< about the side of one
  double ruler = 20;  ///< the greater, the more compact
  int iterations = 5;
  void check() const;
};
void visit(OptionVisitor& field, SuperpixelOptions& options);

/// Two superpixels that touch, a < b.
struct SuperpixelBorder {
  int a = 0, b = 0;
  /// Neighbouring pixels along it: side by side (left to right: `b` on the right of `a` counts as
  /// `beside`, as the other way round), `a` above `b`, and `a` below `b`.
  int beside = 0, above = 0, below = 0;
  int length() const { return beside + above + below; }
};

/// Where a superpixel lies and how it is shaped.
struct RegionShape {
  int area_px = 0;
  float u = 0, v = 0;                              ///< mean of its pixels
  int min_u = 0, max_u = 0, min_v = 0, max_v = 0;  ///< ends included
  float uu = 0, uv = 0, vv = 0;                    ///< central second moments [px^2]
};

/// A picture cut into small regions of one colour that are connected.
struct Superpixels {
  static constexpr int kCoarse = 4;  ///< pixels a pixel of `coarse`, along either side
  int count = 0, rows = 0, cols = 0;
  Image index;   ///< CV_32SC1, from 0 to count - 1
  Image coarse;  ///< every fourth pixel of it
  std::vector<RegionShape> shapes;
  std::vector<SuperpixelBorder> borders;  ///< all pairs that touch, sorted by (a, b)
};

/// SLIC superpixels (Achanta et al. 2012) of a CV_8UC3 BGR picture. The same picture gives the same
/// superpixels. Throws ArgumentError for another type or a picture smaller than two superpixels.
Superpixels cut_superpixels(const Image& bgr, const SuperpixelOptions& options = {});

/// Those of an index image (CV_32SC1, every number from 0 to count - 1 in it).
Superpixels superpixels_of_index(const Image& index, int count);

}  // namespace placegraph
