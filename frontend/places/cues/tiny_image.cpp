#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {

GridSize grid_size(const Image& image, int columns, double scale, int multiple) {
  const auto rounded = [&](double cells) {
    return std::max(1, static_cast<int>(std::lround(cells * scale / multiple))) * multiple;
  };
  const auto whole = [&](double cells) {
    return std::max(1.0, std::round(cells / multiple)) * multiple;
  };
  return {rounded(columns), rounded(whole(static_cast<double>(columns) * image.rows / image.cols))};
}

CueGrid tiny_image_cue(const Image& image, int columns, double scale) {
  require(image.type() == CV_8UC1 || image.type() == CV_8UC3,
          "tiny_image_cue: grey or BGR image needed");
  constexpr int kMultiple = 2;      // even sizes keep the centres of all scales together
  constexpr double kDeviation = 2;  // grey levels; a blank channel stays blank
  const GridSize size = grid_size(image, columns, scale, kMultiple);
  cv::Mat small;
  cv::resize(image, small, {size.columns, size.rows}, 0, 0, cv::INTER_AREA);
  if (small.channels() == 3) cv::cvtColor(small, small, cv::COLOR_BGR2Lab);
  cv::Scalar mean, deviation;
  cv::meanStdDev(small, mean, deviation);
  const int channels = small.channels();
  std::vector<float> values;
  values.reserve(small.total() * static_cast<std::size_t>(channels));
  for (int y = 0; y < small.rows; ++y)
    for (int i = 0; i < small.cols * channels; ++i) {
      const int c = i % channels;
      values.push_back(
          static_cast<float>((small.ptr<uchar>(y)[i] - mean[c]) / (deviation[c] + kDeviation)));
    }
  return make_cue_grid(size.columns, size.rows, channels, values);
}

}  // namespace placegraph
