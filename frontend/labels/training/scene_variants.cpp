#include <placegraph/frontend/labels/training/scene_variants.h>
#include <placegraph/graph/core/error.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Smooth field of factors around 1: three grids of noise, the coarser the stronger.
Image draw_light(cv::Size size, double strength, Random& random) {
  Image field = Image::zeros(size, CV_32F);
  for (const auto& [cells, part] : {std::pair{3, 1.0}, {7, 0.67}, {15, 0.5}}) {
    Image grid(cells, cells * 4 / 3, CV_32F), wide;
    for (int v = 0; v < grid.rows; ++v)
      for (int u = 0; u < grid.cols; ++u)
        grid.at<float>(v, u) = static_cast<float>(random.normal(0, strength * part));
    cv::resize(grid, wide, size, 0, 0, cv::INTER_CUBIC);
    field += wide;
  }
  cv::exp(field, field);
  return field;
}

Image relight(const Image& bgr, Random& random) {
  const double gamma = std::exp(random.uniform(-0.5, 0.7)),
               gain = std::exp(random.uniform(-0.9, 0.3));
  std::array<float, 3> tint;
  for (float& t : tint) t = static_cast<float>(std::exp(random.normal(0, 0.08)));
  const Image light = draw_light(bgr.size(), random.uniform(0, 0.35), random);
  const auto noise = static_cast<float>(random.uniform(0, 8));
  std::array<float, 256> table;
  for (std::size_t i = 0; i < 256; ++i)
    table[i] = static_cast<float>(255 * gain * std::pow(static_cast<double>(i) / 255, gamma));
  Image result(bgr.size(), CV_8UC3);
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const auto& in = bgr.at<cv::Vec3b>(v, u);
      auto& out = result.at<cv::Vec3b>(v, u);
      const std::uint32_t bits = random.next();
      for (int c = 0; c < 3; ++c) {
        // In [-1, 1].
        const float dice = static_cast<float>((bits >> (10 * c)) & 1023u) / 511.5f - 1;
        out[c] = cv::saturate_cast<std::uint8_t>(table[in[c]] * light.at<float>(v, u) *
                                                     tint[static_cast<std::size_t>(c)] +
                                                 noise * dice);
      }
    }
  return result;
}

}  // namespace

SceneVariant vary_scene(const Image& bgr, const Image& labels, std::uint8_t void_label, bool mirror,
                        Random& random) {
  require(bgr.type() == CV_8UC3 && labels.type() == CV_8UC1 && bgr.size() == labels.size(),
          "vary_scene: needs a BGR image and its labels");
  SceneVariant variant{relight(bgr, random), labels.clone()};
  if (mirror) {
    cv::flip(variant.bgr, variant.bgr, 1);
    cv::flip(variant.labels, variant.labels, 1);
  }
  const double zoom = std::exp(random.uniform(-0.05, 0.25));
  const double spare_u = (zoom - 1) * bgr.cols, spare_v = (zoom - 1) * bgr.rows;
  const double du = -spare_u / 2 + random.uniform(-0.5, 0.5) * spare_u;
  const double dv = -spare_v / 2 + random.uniform(-1, 1) * bgr.rows / 12;
  const cv::Matx23d place(zoom, 0, du, 0, zoom, dv);
  cv::warpAffine(variant.bgr, variant.bgr, place, bgr.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  cv::warpAffine(variant.labels, variant.labels, place, bgr.size(), cv::INTER_NEAREST,
                 cv::BORDER_CONSTANT, cv::Scalar(void_label));
  constexpr double kGreyShare = 1.0 / 3;  // many drives are recorded without colour
  if (random.uniform(0, 1) < kGreyShare) {
    Image grey;
    cv::cvtColor(variant.bgr, grey, cv::COLOR_BGR2GRAY);
    cv::cvtColor(grey, variant.bgr, cv::COLOR_GRAY2BGR);
  }
  return variant;
}

}  // namespace placegraph
