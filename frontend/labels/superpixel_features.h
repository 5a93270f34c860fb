#pragma once
#include <placegraph/frontend/labels/superpixels.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace placegraph {

/// Rows of bytes, one per superpixel: the features of a forest.
struct ByteFeatures {
  int count = 0, dimension = 0;
  std::vector<std::uint8_t> values;  ///< count x dimension
  const std::uint8_t* row(int i) const {
    return values.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(dimension);
  }
  std::uint8_t* row(int i) { return const_cast<std::uint8_t*>(std::as_const(*this).row(i)); }
};

constexpr int kSuperpixelFeatures = 32 * 29 + 24 + 14;

/// Colour, texture and edges (see SceneChannels) of each superpixel and of rectangles around it.
///
/// The rectangles are nine cells of a HOG-like grid, nine wider ones, far ones on four sides, the
/// columns above and below, the superpixel's row and the whole image; further features are the
/// spread within the superpixel, its position and its shape.
ByteFeatures superpixel_features(const Image& bgr, const Superpixels& superpixels);

/// Label distributions of each superpixel, of its neighbours above, beside and below, and of
/// rectangles around it (auto-context, Tu 2008). `probabilities`: count x classes bytes, 255 = 1.
ByteFeatures context_features(const ByteFeatures& probabilities, const Superpixels& superpixels);
int context_dimension(int classes);

}  // namespace placegraph
