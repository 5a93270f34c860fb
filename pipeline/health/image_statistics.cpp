#include <placegraph/pipeline/health/image_statistics.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace placegraph {
namespace {

// Every fifth row; detail compares differences over 2 and 8 pixels. Chosen.
constexpr int kRowStep = 5, kNear = 2, kFar = 8, kSmallest = 16;

using Histogram = std::array<std::int64_t, 256>;

std::int64_t squared_differences(const std::uint8_t* a, const std::uint8_t* b, int count) {
  std::int32_t sum = 0;  // holds 2^15 differences at least
  for (int i = 0; i < count; ++i) {
    const int difference = a[i] - b[i];
    sum += difference * difference;
  }
  return sum;
}

/// The grey level below which a share of the pixels lies.
int quantile(const Histogram& histogram, double share, std::int64_t pixels) {
  std::int64_t below = 0;
  for (int level = 0; level < 256; ++level) {
    below += histogram[static_cast<std::size_t>(level)];
    if (static_cast<double>(below) > share * static_cast<double>(pixels)) return level;
  }
  return 255;
}

/// The largest number of pixels within three successive levels, white left out.
std::int64_t most_uniform(const Histogram& histogram) {
  std::int64_t most = 0;
  for (std::size_t level = 1; level + 2 < histogram.size(); ++level)
    most = std::max(most, histogram[level - 1] + histogram[level] + histogram[level + 1]);
  return most;
}

double ratio(std::int64_t near, std::int64_t far) {
  return far > 0 ? static_cast<double>(near) / static_cast<double>(far) : 0;
}

}  // namespace

ImageStatistics image_statistics(const Image& image) {
  // Share of the darkest and of the brightest pixels outside of the range. Chosen.
  constexpr double kTail = 0.02;
  constexpr int kLongest = 1 << 14;
  ImageStatistics statistics;
  if (image.rows < kSmallest || image.cols < kSmallest) return statistics;
  const int columns = std::min(image.cols, kLongest) - kFar;
  Histogram histogram{};
  std::int64_t near_x = 0, far_x = 0, near_y = 0, far_y = 0, pixels = 0, sum = 0;
  for (int v = 0; v + kFar < image.rows; v += kRowStep) {
    const std::uint8_t* row = image.ptr(v);
    for (int u = 0; u < columns; ++u) ++histogram[row[u]];
    near_x += squared_differences(row, row + kNear, columns);
    far_x += squared_differences(row, row + kFar, columns);
    near_y += squared_differences(row, image.ptr(v + kNear), columns);
    far_y += squared_differences(row, image.ptr(v + kFar), columns);
    pixels += columns;
  }
  for (std::int64_t level = 0; level < 256; ++level)
    sum += level * histogram[static_cast<std::size_t>(level)];
  statistics.mean = static_cast<double>(sum) / static_cast<double>(pixels);
  statistics.range = quantile(histogram, 1 - kTail, pixels) - quantile(histogram, kTail, pixels);
  statistics.white = static_cast<double>(histogram[255]) / static_cast<double>(pixels);
  statistics.uniform = static_cast<double>(most_uniform(histogram)) / static_cast<double>(pixels);
  statistics.detail = std::min(ratio(near_x, far_x), ratio(near_y, far_y));
  return statistics;
}

}  // namespace placegraph
