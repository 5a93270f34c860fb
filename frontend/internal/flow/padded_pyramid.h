#pragma once
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// An image in float and its halvings (cv::pyrDown), each mirrored beyond its sides, so that
/// windows may reach over them: pixel (u, v) of level i, which is pixel 2^i (u, v) of the image,
/// lies at (u + pad, v + pad).
struct PaddedPyramid {
  std::vector<Image> levels;  ///< CV_32FC1
  int pad = 0;
  int width = 0, height = 0;  ///< of the image

  int width_at(int level) const { return levels[level].cols - 2 * pad; }
  int height_at(int level) const { return levels[level].rows - 2 * pad; }
};

/// Fewer levels than asked for where a side would fall below `pad` or 8 pixels. Throws
/// ArgumentError unless `grey` is CV_8UC1 and its sides are longer than `pad`.
PaddedPyramid padded_pyramid(const Image& grey, int levels, int pad);

}  // namespace placegraph
