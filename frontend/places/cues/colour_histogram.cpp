#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr int kCountedWidth = 80, kCountedHeight = 60;  // pixels that are counted

/// The two bins beside a position and their shares; a share of zero where there is no bin.
struct Shares {
  std::array<int, 2> bin = {0, 0};
  std::array<float, 2> share = {0, 0};
};

// The bins' centres are at 0, 1, ... With `wrap` the last bin is beside the first; otherwise a
// position beyond the end bins counts for the end bin, or with `lose` for none.
Shares shares_of(float position, int bins, bool wrap, bool lose) {
  const float floor = std::floor(position);
  Shares result;
  result.share = {1 - (position - floor), position - floor};
  for (std::size_t i = 0; i < 2; ++i) {
    int bin = static_cast<int>(floor) + static_cast<int>(i);
    if (wrap) bin = (bin + bins) % bins;
    if (lose && (bin < 0 || bin >= bins)) result.share[i] = 0;
    result.bin[i] = std::clamp(bin, 0, bins - 1);
  }
  return result;
}

}  // namespace

CueGrid colour_histogram_cue(const Image& bgr, const ColourHistogramOptions& options) {
  require(bgr.type() == CV_8UC3, "colour_histogram_cue: BGR image needed");
  cv::Mat small, hsv;
  cv::resize(bgr, small, {kCountedWidth, kCountedHeight}, 0, 0, cv::INTER_AREA);
  small.convertTo(small, CV_32FC3, 1 / 255.0);
  cv::cvtColor(small, hsv, cv::COLOR_BGR2HSV);
  const int bins = options.hues * options.saturations * options.values;
  std::vector<float> histogram(static_cast<std::size_t>(options.cells * options.cells * bins), 0);
  const auto cell_position = [&](int px, int size) {
    return (static_cast<float>(px) + 0.5f) / static_cast<float>(size) *
               static_cast<float>(options.cells) -
           0.5f;
  };
  for (int y = 0; y < kCountedHeight; ++y) {
    const Shares row = shares_of(cell_position(y, kCountedHeight), options.cells, false, true);
    for (int x = 0; x < kCountedWidth; ++x) {
      const cv::Vec3f& pixel = hsv.at<cv::Vec3f>(y, x);
      const Shares column = shares_of(cell_position(x, kCountedWidth), options.cells, false, true);
      const auto top = [](int count) { return static_cast<float>(count - 1); };
      const Shares hue = shares_of(pixel[0] / 360 * static_cast<float>(options.hues) - 0.5f,
                                   options.hues, true, false);
      const Shares saturation =
          shares_of(pixel[1] * top(options.saturations), options.saturations, false, false);
      const Shares value = shares_of(pixel[2] * top(options.values), options.values, false, false);
      std::array<int, 8> bin;
      std::array<float, 8> share;
      for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t h = i & 1, s = i >> 1 & 1, v = i >> 2;
        bin[i] =
            (hue.bin[h] * options.saturations + saturation.bin[s]) * options.values + value.bin[v];
        share[i] = hue.share[h] * saturation.share[s] * value.share[v];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t r = i & 1, c = i >> 1;
        const float of_cell = row.share[r] * column.share[c];
        if (of_cell == 0) continue;
        float* first =
            histogram.data() +
            static_cast<std::ptrdiff_t>(row.bin[r] * options.cells + column.bin[c]) * bins;
        for (std::size_t k = 0; k < 8; ++k) first[bin[k]] += of_cell * share[k];
      }
    }
  }
  for (int cell = 0; cell < options.cells * options.cells; ++cell) {
    float* first = histogram.data() + static_cast<std::ptrdiff_t>(cell) * bins;
    float sum = 0;
    for (int i = 0; i < bins; ++i) sum += first[i];
    for (int i = 0; i < bins; ++i) first[i] = std::sqrt(first[i] / std::max(sum, 1e-9f));
  }
  return make_cue_grid(options.cells, options.cells, bins, histogram);
}

}  // namespace placegraph
