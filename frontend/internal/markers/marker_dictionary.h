#pragma once
#include <placegraph/graph/image/image.h>

#include <string>
#include <vector>

namespace placegraph {

/// The families of square markers that are known by name: "aruco_4x4_50" to "aruco_7x7_1000",
/// "aruco_original", "apriltag_16h5" to "apriltag_36h11".
std::vector<std::string> marker_dictionaries();

/// The markers of a family.
struct MarkerFamily {
  Image codes;               ///< one row a marker, as OpenCV's aruco packs them
  int bits_per_side = 0;     ///< without the black border of one cell on either side
  int correctable_bits = 0;  ///< wrong ones with which a marker is still told from all others

  int count() const { return codes.rows; }
};

/// Throws ArgumentError listing the known names.
MarkerFamily marker_family(const std::string& dictionary);

}  // namespace placegraph
