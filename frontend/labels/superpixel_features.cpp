#include <placegraph/frontend/labels/box_sums.h>
#include <placegraph/frontend/labels/scene_channels.h>
#include <placegraph/frontend/labels/superpixel_features.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

constexpr int kBoxes = 28;    ///< rectangles around a superpixel
constexpr int kSpreads = 24;  ///< channels whose spread within a superpixel is a feature
constexpr int kShapeNumbers = 14;
static_assert(kSuperpixelFeatures ==
              SceneChannels::kCount * (kBoxes + 1) + kSpreads + kShapeNumbers);

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
}

PixelBox box_at(float u, float v, float half_width, float half_height) {
  return {static_cast<int>(std::lround(u - half_width)),
          static_cast<int>(std::lround(v - half_height)),
          static_cast<int>(std::lround(u + half_width)),
          static_cast<int>(std::lround(v + half_height))};
}

/// Rectangles around (u, v) in an image of `cols` x `rows`; `unit` is a 240th of its longer side.
std::array<PixelBox, kBoxes> boxes_around(float u, float v, int cols, int rows) {
  const float unit = static_cast<float>(std::max(cols, rows)) / 240.0f;
  std::array<PixelBox, kBoxes> boxes;
  std::size_t n = 0;
  for (const float side : {9.0f, 27.0f})
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        boxes[n++] =
            box_at(u + static_cast<float>(x) * side * unit, v + static_cast<float>(y) * side * unit,
                   side * unit / 2, side * unit / 2);
  const float far = 65 * unit, half = 14 * unit;
  boxes[n++] = box_at(u - far, v, half, half);
  boxes[n++] = box_at(u + far, v, half, half);
  boxes[n++] = box_at(u, v - far, half, half);
  boxes[n++] = box_at(u, v + far, half, half);
  const int left = static_cast<int>(std::lround(u - 10 * unit)),
            right = static_cast<int>(std::lround(u + 10 * unit));
  const int middle = static_cast<int>(std::lround(v));
  boxes[n++] = {left, 0, right, middle};
  boxes[n++] = {left, middle, right, rows};
  boxes[n++] = {0, middle - static_cast<int>(5 * unit), cols,
                middle + static_cast<int>(5 * unit) + 1};
  boxes[n++] = {0, middle - static_cast<int>(8 * unit), static_cast<int>(u),
                middle + static_cast<int>(8 * unit) + 1};
  boxes[n++] = {static_cast<int>(u), middle - static_cast<int>(8 * unit), cols,
                middle + static_cast<int>(8 * unit) + 1};
  boxes[n++] = {0, 0, cols, rows};
  return boxes;
}

void put_shape(const RegionShape& s, int cols, int rows, std::uint8_t* out) {
  const float width = static_cast<float>(s.max_u - s.min_u + 1),
              height = static_cast<float>(s.max_v - s.min_v + 1);
  const float fu = s.u / static_cast<float>(cols), fv = s.v / static_cast<float>(rows);
  const float trace = s.uu + s.vv + 1e-3f;
  const float spread = std::sqrt((s.uu - s.vv) * (s.uu - s.vv) + 4 * s.uv * s.uv);
  const std::array<float, kShapeNumbers> numbers = {
      fu * 255,
      fv * 255,
      std::abs(fu - 0.5f) * 510,
      static_cast<float>(s.min_v) / static_cast<float>(rows) * 255,
      static_cast<float>(s.max_v) / static_cast<float>(rows) * 255,
      static_cast<float>(s.area_px) * 0.3f,
      width * 4,
      height * 4,
      128 + 60 * std::log(height / width),
      static_cast<float>(s.area_px) / (width * height) * 255,
      spread / trace * 255,
      128 + (s.uu - s.vv) / trace * 127,
      128 + 2 * s.uv / trace * 127,
      std::abs(fu - 0.5f) * 255 + fv * 127};
  for (std::size_t i = 0; i < numbers.size(); ++i) out[i] = byte_of(numbers[i]);
}

/// Writes means over each superpixel, and the spread of the first channels.
void put_own(const SceneChannels& channels, const Superpixels& superpixels, ByteFeatures& features,
             int spread_at) {
  constexpr int n = SceneChannels::kCount;
  std::vector<std::int32_t> sum(static_cast<std::size_t>(superpixels.count) * n, 0),
      square(sum.size(), 0);
  std::vector<std::int32_t> pixels(static_cast<std::size_t>(superpixels.count), 0);
  for (int v = 0; v < channels.rows; ++v) {
    const int* index = superpixels.index.ptr<int>(2 * v);
    for (int u = 0; u < channels.cols; ++u) {
      const auto at = static_cast<std::size_t>(index[2 * u]);
      const std::uint8_t* p = channels.at(v, u);
      ++pixels[at];
      for (std::size_t c = 0; c < n; ++c) {
        sum[at * n + c] += p[c];
        square[at * n + c] += p[c] * p[c];
      }
    }
  }
  for (int i = 0; i < superpixels.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float scale = 1.0f / static_cast<float>(std::max(1, pixels[at]));
    std::uint8_t* out = features.row(i);
    for (std::size_t c = 0; c < n; ++c) {
      const float mean = static_cast<float>(sum[at * n + c]) * scale;
      out[c] = byte_of(mean);
      if (c >= kSpreads) continue;
      const float variance = static_cast<float>(square[at * n + c]) * scale - mean * mean;
      out[static_cast<std::size_t>(spread_at) + c] =
          byte_of(3 * std::sqrt(std::max(0.0f, variance)));
    }
  }
}

}  // namespace

ByteFeatures superpixel_features(const Image& bgr, const Superpixels& superpixels) {
  require(bgr.size() == superpixels.index.size(), "superpixel_features: the sizes do not agree");
  const SceneChannels channels = scene_channels(bgr);
  constexpr int n = SceneChannels::kCount;
  const BoxSums sums(channels.pixels, channels.rows, channels.cols, n);
  ByteFeatures features{superpixels.count, kSuperpixelFeatures, {}};
  features.values.resize(static_cast<std::size_t>(features.count) * kSuperpixelFeatures);
  constexpr int kSpreadAt = n * (kBoxes + 1), kShapeAt = kSpreadAt + kSpreads;
  put_own(channels, superpixels, features, kSpreadAt);
  for (int i = 0; i < superpixels.count; ++i) {
    const RegionShape& shape = superpixels.shapes[static_cast<std::size_t>(i)];
    std::uint8_t* out = features.row(i) + n;
    for (const PixelBox& box :
         boxes_around(shape.u / 2, shape.v / 2, channels.cols, channels.rows)) {
      sums.means(box, out);
      out += n;
    }
    put_shape(shape, bgr.cols, bgr.rows, features.row(i) + kShapeAt);
  }
  return features;
}

int context_dimension(int classes) { return classes * (1 + 4 + kBoxes); }

ByteFeatures context_features(const ByteFeatures& probabilities, const Superpixels& superpixels) {
  require(probabilities.count == superpixels.count, "context_features: the sizes do not agree");
  const int classes = probabilities.dimension;
  const auto n = static_cast<std::size_t>(classes);
  const int rows = superpixels.coarse.rows, cols = superpixels.coarse.cols;
  std::vector<std::uint8_t> map;
  map.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols) * n);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < cols; ++u) {
      const std::uint8_t* p = probabilities.row(superpixels.coarse.at<int>(v, u));
      map.insert(map.end(), p, p + n);
    }
  const BoxSums sums(map, rows, cols, classes);

  // Means over the neighbours above, below and beside, each weighted by the length of the border.
  const auto count = static_cast<std::size_t>(superpixels.count);
  std::vector<float> around(count * 4 * n, 0.0f), length(count * 4, 0.0f);
  const auto give = [&](int to, int from, std::size_t side, int border) {
    if (border == 0) return;
    const std::size_t at = static_cast<std::size_t>(to) * 4 + side;
    length[at] += static_cast<float>(border);
    const std::uint8_t* p = probabilities.row(from);
    for (std::size_t c = 0; c < n; ++c)
      around[at * n + c] += static_cast<float>(border) * static_cast<float>(p[c]);
  };
  for (const SuperpixelBorder& b : superpixels.borders) {
    give(b.b, b.a, 0, b.above), give(b.a, b.b, 1, b.above);
    give(b.a, b.b, 0, b.below), give(b.b, b.a, 1, b.below);
    give(b.a, b.b, 2, b.beside), give(b.b, b.a, 2, b.beside);
    give(b.a, b.b, 3, b.length()), give(b.b, b.a, 3, b.length());
  }

  ByteFeatures features{superpixels.count, context_dimension(classes), {}};
  features.values.resize(count * static_cast<std::size_t>(features.dimension));
  for (int i = 0; i < superpixels.count; ++i) {
    std::uint8_t* out = std::copy_n(probabilities.row(i), n, features.row(i));
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t at = static_cast<std::size_t>(i) * 4 + side;
      for (std::size_t c = 0; c < n; ++c)
        *out++ = length[at] > 0 ? byte_of(around[at * n + c] / length[at]) : 0;
    }
    const RegionShape& shape = superpixels.shapes[static_cast<std::size_t>(i)];
    for (const PixelBox& box :
         boxes_around(shape.u / Superpixels::kCoarse, shape.v / Superpixels::kCoarse, cols, rows)) {
      sums.means(box, out);
      out += n;
    }
  }
  return features;
}

}  // namespace placegraph
