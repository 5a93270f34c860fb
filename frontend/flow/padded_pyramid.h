#pragma once
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// A float image pyramid (cv::pyrDown) with mirrored padding, so that windows may cross the sides.
///
/// Pixel (u, v) of level i, which is pixel 2^i (u, v) of the image, is at (u + pad, v + pad).
struct PaddedPyramid {
  std::vector<Image> levels;  ///< CV_32FC1
  int pad = 0;
  int width = 0, height = 0;  ///< size of the image

  int width_at(int level) const { return levels[level].cols - 2 * pad; }
  int height_at(int level) const { return levels[level].rows - 2 * pad; }
};

/// Builds the pyramid of an image.
///
/// There are fewer levels than requested if a side would fall below `pad` or 8 pixels. Throws
/// ArgumentError unless `grey` is CV_8UC1 and its sides are longer than `pad`.
PaddedPyramid padded_pyramid(const Image& grey, int levels, int pad);

}  // namespace placegraph
