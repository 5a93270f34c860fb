#include "apps/image/draw_flow.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_legend.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace placegraph::apps {
namespace {

/// The size that a tenth of the vectors exceed, and the number of vectors.
struct Extent {
  double size_px = 1;
  std::size_t known = 0;
};

Extent extent_of(const Image& flow) {
  std::vector<float> sizes;
  for (int v = 0; v < flow.rows; ++v) {
    for (int u = 0; u < flow.cols; ++u) {
      const auto& d = flow.at<cv::Vec2f>(v, u);
      const float size = std::hypot(d[0], d[1]);
      if (std::isfinite(size)) sizes.push_back(size);
    }
  }
  if (sizes.empty()) return {};
  const auto tenth = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
  std::nth_element(sizes.begin(), tenth, sizes.end());
  return {std::max(0.1, static_cast<double>(*tenth)), sizes.size()};
}

cv::Vec3b colour_of(const cv::Vec2f& d, double full_px, double grey) {
  const double hue = std::atan2(d[1], d[0]) / (2 * CV_PI) + 0.5;  // 0 to 1
  const double strength = std::min(1.0, std::hypot(d[0], d[1]) / full_px);
  cv::Vec3b colour;
  for (int k = 0; k < 3; ++k) {  // blue, green, red: three waves a third of a circle apart
    const double wave = 0.5 + 0.5 * std::cos(2 * CV_PI * (hue - (2 - k) / 3.0));
    const double tone = 255 * (1 - strength * (1 - wave));
    colour[k] = cv::saturate_cast<unsigned char>(0.75 * tone + 0.25 * grey);
  }
  return colour;
}

/// A wheel of the colours, and beside it what they mean.
Image wheel_strip(double full_px, int width, const std::string& wanted) {
  constexpr int kSide = 108, kMargin = 8;
  constexpr double kRadius = kSide / 2.0 - kMargin;
  const Image text = legend_strip(
      {},
      {"Hue: the direction of the flow", "Centre: no motion",
       fmt::format("Rim: {:.{}f} px or more", full_px, full_px < 10 ? 1 : 0), "Grey: unknown"},
      std::max(width - kSide, 0), wanted);
  Image strip(std::max(kSide, text.rows), kSide + text.cols, CV_8UC3, cv::Scalar::all(255));
  text.copyTo(strip(cv::Rect(kSide, 0, text.cols, text.rows)));
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) {
      const cv::Vec2f d(static_cast<float>((u - kSide / 2) * full_px / kRadius),
                        static_cast<float>((v - kSide / 2) * full_px / kRadius));
      if (std::hypot(d[0], d[1]) <= full_px) strip.at<cv::Vec3b>(v, u) = colour_of(d, full_px, 255);
    }
  return strip;
}

}  // namespace

Image draw_flow(const Image& grey, const Image& flow, const std::string& wanted) {
  Image drawing;
  cv::cvtColor(grey, drawing, cv::COLOR_GRAY2BGR);
  const Extent extent = extent_of(flow);
  const bool dense = extent.known * 2 > flow.total();
  for (int v = 0; v < flow.rows; ++v) {
    for (int u = 0; u < flow.cols; ++u) {
      const auto& d = flow.at<cv::Vec2f>(v, u);
      if (!(std::isfinite(d[0]) && std::isfinite(d[1]))) continue;
      const cv::Vec3b colour =
          colour_of(d, extent.size_px, dense ? grey.at<unsigned char>(v, u) : 0);
      if (dense) {
        drawing.at<cv::Vec3b>(v, u) = colour;
      } else {
        const cv::Point end(cvRound(static_cast<float>(u) + d[0]),
                            cvRound(static_cast<float>(v) + d[1]));
        cv::line(drawing, {u, v}, end, cv::Scalar(colour), 1, cv::LINE_AA);
      }
    }
  }
  return stacked(drawing, wheel_strip(extent.size_px, drawing.cols, wanted));
}

}  // namespace placegraph::apps
