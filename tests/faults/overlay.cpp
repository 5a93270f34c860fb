// Faults that cover a part of every image with what is fixed to the camera.
#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kOverlay = "static_overlay";

/// Sharp random blocks over a fraction of the image's area, at a place that the seed chooses.
Image with_blocks(const Image& image, double fraction, std::uint32_t seed) {
  cv::RNG random = random_of(seed, 0);
  const double side = std::sqrt(fraction);
  const cv::Size size(static_cast<int>(image.cols * side), static_cast<int>(image.rows * side));
  const cv::Point corner(random.uniform(0, image.cols - size.width + 1),
                         random.uniform(0, image.rows - size.height + 1));
  const int block = std::max(4, image.cols / 80);
  Image out = image.clone();
  for (int v = 0; v < size.height; v += block)
    for (int u = 0; u < size.width; u += block)
      cv::rectangle(out,
                    cv::Rect(corner.x + u, corner.y + v, std::min(block, size.width - u),
                             std::min(block, size.height - v)),
                    cv::Scalar(random.uniform(0, 256)), cv::FILLED);
  return out;
}

cv::Size part_of(cv::Size size, double factor) {
  return {static_cast<int>(size.width * factor), static_cast<int>(size.height * factor)};
}

/// A bright mark with a name on it in the upper left corner.
Image with_logo(const Image& image, std::size_t) {
  Image out = image.clone();
  const cv::Size half(image.cols / 6, image.rows / 6);
  const cv::Point centre(half.width, half.height);
  cv::ellipse(out, centre, half, 0, 0, 360, cv::Scalar(245), cv::FILLED);
  cv::ellipse(out, centre, part_of(half, 0.85), 0, 0, 360, cv::Scalar(20), 2);
  cv::putText(out, "ROBOT 7", {half.width / 3, half.height + half.height / 4},
              cv::FONT_HERSHEY_DUPLEX, half.width / 90.0, cv::Scalar(0), 2);
  return out;
}

/// Blurred dark spots as of drops and dust on the glass.
Image with_dirt(const Image& image, std::uint32_t seed) {
  cv::RNG random = random_of(seed, 0);
  Image clear(image.size(), CV_32FC1, cv::Scalar(1)), light, out;
  for (int spot = 0; spot < 40; ++spot) {
    const cv::Point centre(random.uniform(0, image.cols), random.uniform(0, image.rows));
    cv::circle(clear, centre, random.uniform(image.cols / 80 + 1, image.cols / 25 + 2),
               cv::Scalar(random.uniform(0.1, 0.5)), cv::FILLED);
  }
  cv::GaussianBlur(clear, clear, {}, image.cols / 200.0);
  image.convertTo(light, CV_32F);
  Image(light.mul(clear)).convertTo(out, CV_8U);
  return out;
}

/// A car's bonnet over the lowest quarter, with an edge, a seam and highlights.
Image with_bonnet(const Image& image, std::size_t) {
  Image out = image.clone();
  const cv::Point centre(image.cols / 2, image.rows);
  const cv::Size half(image.cols * 6 / 10, image.rows / 4);
  cv::ellipse(out, centre, half, 0, 0, 360, cv::Scalar(70), cv::FILLED);
  cv::ellipse(out, centre, half, 0, 0, 360, cv::Scalar(190), 2);
  cv::ellipse(out, centre, part_of(half, 0.7), 0, 180, 360, cv::Scalar(30), 2);
  for (int i = 0; i < 7; ++i)
    cv::ellipse(out, {image.cols * (2 + i) / 10, image.rows - image.rows / 12},
                {image.cols / 60 + i, image.rows / 60 + 1}, 20 * i, 0, 360,
                cv::Scalar(150 + 10 * i), cv::FILLED);
  return out;
}

/// The time of the frame, written into the image, as recorders do.
Image with_time_text(const Image& image, std::size_t index) {
  Image out = image.clone();
  const double size = image.cols / 750.0;
  const std::string text = fmt::format("CAM 01  2020-05-17  12:{:02d}:{:02d}.{}", index / 600 % 60,
                                       index / 10 % 60, index % 10);
  cv::putText(out, text, {image.cols / 50, static_cast<int>(30 * size)}, cv::FONT_HERSHEY_SIMPLEX,
              size, cv::Scalar(255), 2);
  cv::putText(out, "REC  1280x720  25 FPS",
              {image.cols / 50, image.rows - static_cast<int>(10 * size)}, cv::FONT_HERSHEY_SIMPLEX,
              size, cv::Scalar(255), 2);
  return out;
}

/// Two thirds of the image are covered by something grey, on the right.
Image covered(const Image& image, std::size_t) {
  Image out = image.clone();
  out.colRange(image.cols / 3, image.cols).setTo(90);
  return out;
}

Fault blocks(int percent) {
  return {fmt::format("overlay_blocks_{}", percent), kAll,
          fmt::format("sharp blocks over {} % of every image, at one place", percent), kOverlay,
          [percent](const Recording& r, std::uint32_t seed) {
            return with_images(r, whole(r), [&](const Image& image, std::size_t) {
              return with_blocks(image, percent / 100.0, seed);
            });
          }};
}

}  // namespace

std::vector<Fault> overlay_faults() {
  return {
      blocks(5),
      blocks(15),
      blocks(25),
      blocks(33),
      {"overlay_logo", kAll, "a mark in the corner of every image, 9 % of it", kOverlay,
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), with_logo); }},
      {"overlay_dirt", kAll, "40 blurred spots on the lens", kOverlay,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r),
                            [seed](const Image& i, std::size_t) { return with_dirt(i, seed); });
       }},
      {"overlay_bonnet", kAll, "the vehicle's bonnet in the lowest quarter", kOverlay,
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), with_bonnet); }},
      {"overlay_time_text", kAll, "the time is written into every image", kOverlay,
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), with_time_text); }},
      {"covered", kAll, "two thirds of the image are covered in four tenths of the frames",
       "static_overlay|images_unusable|drift_large|jump|few_posed",
       [](const Recording& r, std::uint32_t) {
         return with_images(r, part(r, 0.4, 0.8), covered);
       }},
  };
}

}  // namespace placegraph::faults
