#pragma once
#include <placegraph/graph/measurements/data_note.h>

#include <string>
#include <vector>

namespace placegraph {

/// The range of grey levels that images use, out of those that their files can store.
struct ImageLevels {
  bool of_16 = false;  ///< whether there are 16-bit images
  /// Number of used bits of 16-bit images: 8 to 16. One number for a sequence, so that brightness
  /// remains comparable from image to image.
  int bits = 16;
  std::vector<DataNote> notes;  ///< few bits of 16, very dark images, hardly any contrast
};

/// Samples up to eight images, evenly spaced in the list, but at most one in twenty of 8-bit
/// images, because sampling an image costs as much as reading it. Unreadable images are skipped:
/// the error is thrown where they are needed.
ImageLevels sample_levels(const std::vector<std::string>& paths);

}  // namespace placegraph
