#pragma once
#include <placegraph/graph/image/image.h>

#include <string>
#include <vector>

namespace placegraph {

/// The markers of a family.
struct MarkerFamily {
  Image codes;               ///< one row per marker, in the packing of OpenCV's aruco
  int bits_per_side = 0;     ///< without the black border of one cell on either side
  int correctable_bits = 0;  ///< wrong bits up to which a marker is still unique

  int count() const { return codes.rows; }
};

/// The markers of a dictionary; throws ArgumentError with the known names if it is unknown.
MarkerFamily marker_family(const std::string& dictionary);

}  // namespace placegraph
