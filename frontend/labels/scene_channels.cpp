#include <placegraph/frontend/labels/scene_channels.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

using C = SceneChannels;
constexpr int kDirections = 6;
static_assert(C::kEnd <= C::kCount);

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
}

/// Writes a plane of floats, times `scale` plus `offset`, to one channel.
void put(SceneChannels& channels, int channel, const Image& plane, float scale, float offset) {
  std::uint8_t* out = channels.pixels.data() + channel;
  for (int v = 0; v < channels.rows; ++v) {
    const float* in = plane.ptr<float>(v);
    for (int u = 0; u < channels.cols; ++u, out += C::kCount) *out = byte(in[u] * scale + offset);
  }
}

Image blurred(const Image& plane, double sigma) {
  Image result;
  cv::GaussianBlur(plane, result, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return result;
}

float median_of_plane(const Image& plane) {
  std::vector<float> values;
  for (int v = 0; v < plane.rows; v += 2)
    for (int u = 0; u < plane.cols; u += 2) values.push_back(plane.at<float>(v, u));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void put_colour(SceneChannels& channels, const Image& half) {
  const int rows = half.rows, cols = half.cols;
  Image red(rows, cols, CV_32F), blue(rows, cols, CV_32F), saturation(rows, cols, CV_32F),
      blueness(rows, cols, CV_32F), greenness(rows, cols, CV_32F);
  std::array<float, 256> logarithm;
  for (int i = 0; i < 256; ++i)
    logarithm[static_cast<std::size_t>(i)] = std::log(static_cast<float>(i) + 10.0f);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < cols; ++u) {
      const auto& p = half.at<cv::Vec3b>(v, u);
      const float b = logarithm[p[0]], g = logarithm[p[1]], r = logarithm[p[2]];
      red.at<float>(v, u) = r - g;
      blue.at<float>(v, u) = b - g;
      const int most = std::max({p[0], p[1], p[2]}), least = std::min({p[0], p[1], p[2]});
      saturation.at<float>(v, u) = static_cast<float>(most - least) / static_cast<float>(most + 10);
      blueness.at<float>(v, u) = b - 0.5f * (r + g);
      greenness.at<float>(v, u) = g - 0.5f * (r + b);
    }
  constexpr float kScale = 150, kMiddle = 128;
  put(channels, C::kRed, red, kScale, kMiddle);
  put(channels, C::kBlue, blue, kScale, kMiddle);
  put(channels, C::kRedRelative, red, kScale, kMiddle - kScale * median_of_plane(red));
  put(channels, C::kBlueRelative, blue, kScale, kMiddle - kScale * median_of_plane(blue));
  put(channels, C::kSaturation, saturation, 255, 0);
  put(channels, C::kBlueness, blueness, kScale, kMiddle);
  put(channels, C::kGreenness, greenness, 2 * kScale, kMiddle);
}

void put_brightness(SceneChannels& channels, const Image& grey_half) {
  Image ranked, plane;
  cv::equalizeHist(grey_half, ranked);
  grey_half.convertTo(plane, CV_32F);
  put(channels, C::kBrightness, plane, 1, 0);
  ranked.convertTo(ranked, CV_32F);
  put(channels, C::kRank, ranked, 1, 0);

  // Ratios, not differences: a shadow scales the brightness within it.
  Image log_plane;
  cv::log(plane + 10.0f, log_plane);
  Image square;
  cv::multiply(log_plane, log_plane, square);
  Image mean, mean_square;
  cv::boxFilter(log_plane, mean, CV_32F, {5, 5});
  cv::boxFilter(square, mean_square, CV_32F, {5, 5});
  Image deviation = mean_square - mean.mul(mean);
  deviation = cv::max(deviation, 0.0f);
  cv::sqrt(deviation, deviation);
  put(channels, C::kContrast, deviation, 500, 0);

  std::array<Image, 4> scales = {blurred(log_plane, 0.7), blurred(log_plane, 1.4),
                                 blurred(log_plane, 2.8), blurred(log_plane, 5.6)};
  for (std::size_t i = 0; i < 3; ++i)
    put(channels, C::kBlob + static_cast<int>(i), cv::abs(scales[i] - scales[i + 1]), 800, 0);
  Image wide;
  cv::boxFilter(log_plane, wide, CV_32F, {41, 41});
  put(channels, C::kShade, scales[2] - wide, 120, 128);
}

/// log(I + 10): a change of light adds the same everywhere.
Image log_of(const Image& grey) {
  Image plane;
  grey.convertTo(plane, CV_32F, 1, 10);
  cv::log(plane, plane);
  return plane;
}

/// Soft shares of a gradient in the two directions nearest to its own; angle in [0, pi).
void put_edges(SceneChannels& channels, const Image& grey) {
  Image gx, gy, magnitude, angle;
  const Image plane_of_logs = log_of(grey);
  cv::Sobel(plane_of_logs, gx, CV_32F, 1, 0);
  cv::Sobel(plane_of_logs, gy, CV_32F, 0, 1);
  cv::cartToPolar(gx, gy, magnitude, angle);
  const float mean = static_cast<float>(cv::mean(magnitude)[0]) + 0.05f;
  const int rows = channels.rows, cols = channels.cols;
  std::array<Image, kDirections> planes;
  for (Image& plane : planes) plane = Image::zeros(rows, cols, CV_32F);
  Image strength = Image::zeros(rows, cols, CV_32F);
  constexpr float kBinOfRadian = kDirections / 3.14159265f;
  for (int v = 0; v < 2 * rows; ++v) {
    const float *m = magnitude.ptr<float>(v), *a = angle.ptr<float>(v);
    for (int u = 0; u < 2 * cols; ++u) {
      const float s = m[u] / (m[u] + 2 * mean) * 0.25f;
      const float at = a[u] * kBinOfRadian;
      const int low = static_cast<int>(at);
      const float rest = at - static_cast<float>(low);
      planes[static_cast<std::size_t>(low % kDirections)].at<float>(v / 2, u / 2) += (1 - rest) * s;
      planes[static_cast<std::size_t>((low + 1) % kDirections)].at<float>(v / 2, u / 2) += rest * s;
      strength.at<float>(v / 2, u / 2) += s;
    }
  }
  put(channels, C::kEdge, strength, 255, 0);
  Image around;
  cv::boxFilter(strength, around, CV_32F, {9, 9});
  around += 0.01f;
  for (int i = 0; i < kDirections; ++i) {
    const Image& plane = planes[static_cast<std::size_t>(i)];
    put(channels, C::kDirection + i, plane, 400, 0);
    Image share;
    cv::boxFilter(plane, share, CV_32F, {9, 9});
    cv::divide(share, around, share);
    put(channels, C::kShare + i, share, 255, 0);
  }
}

void put_coarse_edges(SceneChannels& channels, const Image& grey_half) {
  Image gx, gy, magnitude;
  const Image plane = blurred(log_of(grey_half), 2.5);
  cv::Sobel(plane, gx, CV_32F, 1, 0);
  cv::Sobel(plane, gy, CV_32F, 0, 1);
  cv::magnitude(gx, gy, magnitude);
  const Image scaled = magnitude + (2 * cv::mean(magnitude)[0] + 0.05);
  Image part;
  cv::divide(magnitude, scaled, part);
  put(channels, C::kCoarseEdge, part, 255, 0);
  cv::divide(cv::abs(gx), scaled, part);
  put(channels, C::kCoarseUpright, part, 255, 0);
  cv::divide(cv::abs(gy), scaled, part);
  put(channels, C::kCoarseLevel, part, 255, 0);
}

}  // namespace

SceneChannels scene_channels(const Image& bgr) {
  require(bgr.type() == CV_8UC3 && bgr.rows >= 2 && bgr.cols >= 2 && bgr.rows % 2 == 0 &&
              bgr.cols % 2 == 0,
          "scene_channels: needs a CV_8UC3 image with even sides");
  SceneChannels channels;
  channels.rows = bgr.rows / 2;
  channels.cols = bgr.cols / 2;
  channels.pixels.assign(
      static_cast<std::size_t>(channels.rows) * static_cast<std::size_t>(channels.cols) * C::kCount,
      0);
  Image half, grey, grey_half;
  cv::resize(bgr, half, {channels.cols, channels.rows}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(half, grey_half, cv::COLOR_BGR2GRAY);
  put_colour(channels, half);
  put_brightness(channels, grey_half);
  put_edges(channels, grey);
  put_coarse_edges(channels, grey_half);
  return channels;
}

}  // namespace placegraph
