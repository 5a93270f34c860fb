#include <placegraph/frontend/labels/box_sums.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {

BoxSums::BoxSums(const std::vector<std::uint8_t>& pixels, int rows, int cols, int channels)
    : rows_(rows), cols_(cols), channels_(channels) {
  require(rows > 0 && cols > 0 && channels > 0 &&
              pixels.size() == static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols) *
                                   static_cast<std::size_t>(channels),
          "BoxSums: the sizes do not agree");
  require(static_cast<std::int64_t>(rows) * cols <= 1 << 23, "BoxSums: too many pixels");
  const auto n = static_cast<std::size_t>(channels);
  const std::size_t stride = static_cast<std::size_t>(cols + 1) * n;
  sums_.assign(static_cast<std::size_t>(rows + 1) * stride, 0);
  std::vector<std::int32_t> row(n);
  const std::uint8_t* in = pixels.data();
  for (int v = 0; v < rows; ++v) {
    std::fill(row.begin(), row.end(), 0);
    const std::int32_t* above = sums_.data() + static_cast<std::size_t>(v) * stride + n;
    std::int32_t* out = sums_.data() + static_cast<std::size_t>(v + 1) * stride + n;
    for (int u = 0; u < cols; ++u, in += n, above += n, out += n)
      for (std::size_t c = 0; c < n; ++c) {
        row[c] += in[c];
        out[c] = above[c] + row[c];
      }
  }
}

void BoxSums::means(PixelBox box, std::uint8_t* means) const {
  const auto within = [](int& low, int& high, int size) {
    low = std::clamp(low, 0, size - 1);
    high = std::clamp(high, low + 1, size);
  };
  within(box.u0, box.u1, cols_);
  within(box.v0, box.v1, rows_);
  const auto at = [&](int v, int u) {
    return sums_.data() + (static_cast<std::size_t>(v) * static_cast<std::size_t>(cols_ + 1) +
                           static_cast<std::size_t>(u)) *
                              static_cast<std::size_t>(channels_);
  };
  const std::int32_t *a = at(box.v0, box.u0), *b = at(box.v0, box.u1), *c = at(box.v1, box.u0),
                     *d = at(box.v1, box.u1);
  const float scale = 1.0f / static_cast<float>((box.u1 - box.u0) * (box.v1 - box.v0));
  for (int k = 0; k < channels_; ++k)
    means[k] =
        static_cast<std::uint8_t>(static_cast<float>(d[k] - b[k] - c[k] + a[k]) * scale + 0.5f);
}

}  // namespace placegraph
