// Faults of what the camera sees: moving objects, walls without texture, mirrors, weather.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kUnusable = "images_unusable|few_posed|lost_frames|components";
constexpr auto kMotion = "drift_large|jump|scale_questionable|few_posed";

/// A picture of random blocks with soft edges.
Image block_picture(cv::Size size, std::uint32_t seed) {
  cv::RNG random = random_of(seed, 0);
  const int block = std::max(4, size.width / 20);
  Image small(size.height / block + 1, size.width / block + 1, CV_8UC1), out;
  random.fill(small, cv::RNG::UNIFORM, 20, 236);
  cv::resize(small, out, size, 0, 0, cv::INTER_NEAREST);
  cv::GaussianBlur(out, out, {}, 0.8);
  return out;
}

/// Draws a picture with its left edge at column `left`; what lies outside the image is cut.
Image with_picture(const Image& image, const Image& picture, int left) {
  const int begin = std::max(0, left), end = std::min(image.cols, left + picture.cols);
  Image out = image.clone();
  if (begin < end) picture.colRange(begin - left, end - left).copyTo(out.colRange(begin, end));
  return out;
}

/// Something as high as the image and a third as wide that crosses it from left to right, at a
/// depth of 8 % of the largest disparity that its width allows.
Recording with_moving_object(const Recording& recording, std::uint32_t seed) {
  const Span span = part(recording, 0.3, 0.8);
  const Image& first = recording.frames[0].image;
  const Image picture = block_picture({first.cols / 3, first.rows}, seed);
  const auto left_at = [&](std::size_t index) {
    const double fraction = static_cast<double>(index - span.first + 1) /
                            static_cast<double>(span.last - span.first + 2);
    return static_cast<int>(std::lround(fraction * (first.cols + picture.cols))) - picture.cols;
  };
  const int disparity_px = std::max(2, first.cols / 25);
  Recording out = recording;
  out.faulty = span;
  for (std::size_t i = span.first; i <= span.last; ++i) {
    Frame& frame = out.frames[i];
    frame.image = with_picture(frame.image, picture, left_at(i));
    if (!frame.right.empty())
      frame.right = with_picture(frame.right, picture, left_at(i) - disparity_px);
    if (frame.depth.empty()) continue;
    const double scale = static_cast<double>(frame.depth.cols) / first.cols;
    const Image near(frame.depth.rows, std::max(1, static_cast<int>(picture.cols * scale)),
                     CV_32FC1, cv::Scalar(1));
    frame.depth = with_picture(frame.depth, near, static_cast<int>(left_at(i) * scale));
  }
  return out;
}

/// A wall without texture, a metre before the camera.
Recording with_plain_wall(const Recording& recording, std::size_t frames, std::uint32_t seed) {
  const Span span = middle(recording, frames);
  Recording out = with_images(recording, span, [seed](const Image& image, std::size_t index) {
    cv::RNG random = random_of(seed, index);
    Image wall(image.size(), CV_8UC1);
    random.fill(wall, cv::RNG::NORMAL, 150, 1.5);
    return wall;
  });
  return with_depth(out, span, [](const Image& depth, std::size_t) {
    return Image(depth.size(), CV_32FC1, cv::Scalar(1));
  });
}

Image mirrored(const Image& image, std::size_t) {
  Image out;
  cv::flip(image, out, 1);
  return out;
}

/// White flakes of 2 to 6 pixels, at other places in every image.
Image with_snow(const Image& image, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image out = image.clone();
  const int flakes = image.cols * image.rows / 400;
  for (int i = 0; i < flakes; ++i) {
    const cv::Point centre(random.uniform(0, image.cols), random.uniform(0, image.rows));
    cv::circle(out, centre, random.uniform(1, 4), cv::Scalar(random.uniform(180, 256)), cv::FILLED);
  }
  return out;
}

/// Every image shows the left half of the scene twice.
Image with_half_repeated(const Image& image, std::size_t) {
  Image out = image.clone();
  const int half = image.cols / 2;
  image.colRange(0, half).copyTo(out.colRange(image.cols - half, image.cols));
  return out;
}

/// A light that shines into the lens and wanders over the image.
Image with_flare(const Image& image, std::size_t index) {
  Image light(image.size(), CV_8UC1, cv::Scalar(0)), out;
  const int u = static_cast<int>(index * 7) % image.cols;
  cv::circle(light, {u, image.rows / 3}, image.rows / 3, cv::Scalar(220), cv::FILLED);
  cv::GaussianBlur(light, light, {}, image.rows / 8.0);
  cv::add(image, light, out);
  return out;
}

}  // namespace

std::vector<Fault> scene_faults() {
  return {
      {"moving_object", kAll, "something crosses the image and fills a third of it", kMotion,
       with_moving_object},
      {"plain_wall", kAll, "20 frames show a wall without texture", kUnusable,
       [](const Recording& r, std::uint32_t seed) { return with_plain_wall(r, 20, seed); }},
      {"mirrored_while", kAll, "images are mirrored for a fifth of the sequence",
       "jump|components|lost_frames|few_posed|images_unusable",
       [](const Recording& r, std::uint32_t) {
         return with_images(r, part(r, 0.5, 0.7), mirrored);
       }},
      {"snow", kAll, "white flakes cover 5 % of every image, at other places", kMotion,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_snow(image, seed, i);
         });
       }},
      {"half_repeated", kAll, "the right half of the image repeats the left one for a third",
       "calibration_questionable|images_unusable|drift_large|jump|scale_questionable",
       [](const Recording& r, std::uint32_t) {
         return with_images(r, part(r, 0.4, 0.73), with_half_repeated);
       }},
      {"flare", kAll, "a light shines into the lens", "-",
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), with_flare); }},
  };
}

}  // namespace placegraph::faults
