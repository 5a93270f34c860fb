#pragma once
#include <placegraph/graph/measurements/data_note.h>

#include <string>
#include <vector>

namespace placegraph {

/// How images use the grey levels that their files have room for.
struct ImageLevels {
  bool of_16 = false;  ///< whether there are images of 16 bits
  /// Bits in use of images of 16: 8 to 16. One number for a sequence, so that brightness stays
  /// comparable from image to image.
  int bits = 16;
  std::vector<DataNote> notes;  ///< few bits of 16, very dark images, hardly any contrast
};

/// Looks at up to eight images, evenly spaced in the list; of 8 bits at one in twenty, as each of
/// them costs what reading it costs. Unreadable ones are passed over: whoever
/// needs them says so.
ImageLevels sample_levels(const std::vector<std::string>& paths);

}  // namespace placegraph
