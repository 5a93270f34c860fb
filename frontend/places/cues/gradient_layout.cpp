#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Gradient energy by cell and orientation.
std::vector<float> histograms(const cv::Mat& grey, GridSize size, const GradientLayoutOptions& o) {
  cv::Mat dx, dy;
  cv::Sobel(grey, dx, CV_32F, 1, 0, 1);
  cv::Sobel(grey, dy, CV_32F, 0, 1, 1);
  cv::Mat magnitudes, angles;
  cv::cartToPolar(dx, dy, magnitudes, angles, true);
  std::vector<float> cells(static_cast<std::size_t>(size.columns * size.rows * o.orientations), 0);
  const auto cell_of = [&](int px) {
    return (static_cast<float>(px) + 0.5f) / static_cast<float>(o.cell_px) - 0.5f;
  };
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) {
      const float magnitude = magnitudes.at<float>(y, x);
      if (magnitude == 0) continue;
      float angle = angles.at<float>(y, x);
      while (angle >= 180) angle -= 180;  // both directions of an edge are one orientation
      const float bin = angle / 180 * static_cast<float>(o.orientations);
      const float u = cell_of(x), v = cell_of(y);
      const float u0 = std::floor(u), v0 = std::floor(v), b0 = std::floor(bin);
      for (int i = 0; i < 8; ++i) {
        const int column = static_cast<int>(u0) + (i & 1),
                  row = static_cast<int>(v0) + (i >> 1 & 1);
        if (column < 0 || row < 0 || column >= size.columns || row >= size.rows) continue;
        const int orientation = (static_cast<int>(b0) + (i >> 2)) % o.orientations;
        const float share = ((i & 1) ? u - u0 : 1 - (u - u0)) *
                            ((i >> 1 & 1) ? v - v0 : 1 - (v - v0)) *
                            ((i >> 2) ? bin - b0 : 1 - (bin - b0));
        cells[static_cast<std::size_t>((row * size.columns + column) * o.orientations +
                                       orientation)] += share * magnitude;
      }
    }
  return cells;
}

/// Divides every cell by the root mean square length of the 3x3 cells about it.
void normalize(std::vector<float>& cells, GridSize size, int orientations) {
  cv::Mat squares(size.rows, size.columns, CV_32F, cv::Scalar(0)), energy;
  for (int i = 0; i < size.rows * size.columns; ++i) {
    float& square = squares.at<float>(i / size.columns, i % size.columns);
    for (int k = 0; k < orientations; ++k) {
      const float value = cells[static_cast<std::size_t>(i * orientations + k)];
      square += value * value;
    }
  }
  cv::blur(squares, energy, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
  cv::sqrt(energy, energy);
  // A tenth of the mean keeps the noise of blank walls small.
  const float floor = 0.1f * static_cast<float>(cv::mean(energy)[0]) + 1e-6f;
  for (int i = 0; i < size.rows * size.columns; ++i)
    for (int k = 0; k < orientations; ++k) {
      float& value = cells[static_cast<std::size_t>(i * orientations + k)];
      value =
          std::min(1.0f, value / (energy.at<float>(i / size.columns, i % size.columns) + floor));
    }
}

}  // namespace

std::vector<float> gradient_layout(const Image& grey, const GradientLayoutOptions& options,
                                   double scale) {
  require(grey.type() == CV_8UC1, "gradient_layout_cue: grey image needed");
  const GridSize size = grid_size(grey, options.columns, scale, 1);
  cv::Mat small;
  cv::resize(grey, small, {size.columns * options.cell_px, size.rows * options.cell_px}, 0, 0,
             cv::INTER_AREA);
  std::vector<float> cells = histograms(small, size, options);
  normalize(cells, size, options.orientations);
  return cells;
}

CueGrid gradient_layout_cue(const Image& grey, const GradientLayoutOptions& options, double scale) {
  const std::vector<float> cells = gradient_layout(grey, options, scale);
  const GridSize size = grid_size(grey, options.columns, scale, 1);
  return make_cue_grid(size.columns, size.rows, options.orientations, cells);
}

}  // namespace placegraph
