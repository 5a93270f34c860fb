// Faults of the depth images.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kDepth = "rgbd";
constexpr auto kMismatch = "depth_mismatch";

Fault unit(const char* name, const char* what, double factor) {
  const std::string causes = "depth_unit_questionable|scale_questionable";
  return {name, kDepth, what, causes + (is_plausible(factor) ? kUnchecked : ""),
          [factor](const Recording& recording, std::uint32_t) {
            Recording out = recording;
            out.faulty = whole(recording);
            out.stated_depth_unit_m *= factor;
            return out;
          }};
}

Recording with_depth_of(const Recording& recording,
                        const std::function<std::size_t(std::size_t)>& number) {
  return with_depth(recording, whole(recording), [&](const Image&, std::size_t index) {
    return recording.frames[number(index)].depth;
  });
}

Fault late(std::size_t frames) {
  return {fmt::format("depth_late_{}", frames), kDepth,
          fmt::format("the depth image is {} frame{} late", frames, frames > 1 ? "s" : ""),
          kMismatch, [frames](const Recording& r, std::uint32_t) {
            return with_depth_of(r,
                                 [frames](std::size_t i) { return i < frames ? 0 : i - frames; });
          }};
}

/// The depth images of the sequence in random order.
Recording with_depth_of_others(const Recording& recording, std::uint32_t seed) {
  std::vector<std::size_t> numbers(recording.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  cv::RNG random = random_of(seed, 0);
  for (std::size_t i = numbers.size() - 1; i > 0; --i)
    std::swap(numbers[i],
              numbers[static_cast<std::size_t>(random.uniform(0, static_cast<int>(i) + 1))]);
  return with_depth_of(recording, [&](std::size_t index) { return numbers[index]; });
}

Image flipped(const Image& depth, int about) {
  Image out;
  cv::flip(depth, out, about);
  return out;
}

/// No measurement in random rectangles, which cover about half of the image.
Image with_holes(const Image& depth, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image out = depth.clone();
  for (int i = 0; i < 25; ++i) {
    const cv::Size size(depth.cols / 6, depth.rows / 6);
    out(cv::Rect(random.uniform(0, depth.cols - size.width),
                 random.uniform(0, depth.rows - size.height), size.width, size.height)) = 0;
  }
  return out;
}

/// Independent noise of each pixel, in proportion to its depth.
Image with_depth_noise(const Image& depth, double fraction, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image factor(depth.size(), CV_32FC1);
  random.fill(factor, cv::RNG::NORMAL, 1, fraction);
  const Image positive = cv::max(factor, 0.1);
  return depth.mul(positive);
}

/// A constant is added to all that was measured.
Image with_offset(const Image& depth, double offset_m) {
  Image out = depth + offset_m;
  out.setTo(0, depth == 0);
  return out;
}

Fault each(const char* name, const char* what, const char* causes, const ImageChange& change) {
  return {name, kDepth, what, causes,
          [change](const Recording& r, std::uint32_t) { return with_depth(r, whole(r), change); }};
}

std::vector<Fault> faults_of_pairing() {
  return {
      late(1),
      late(5),
      late(20),
      each("depth_mirrored", "the depth image is mirrored", kMismatch,
           [](const Image& depth, std::size_t) { return flipped(depth, 1); }),
      each("depth_upside_down", "the depth image is upside down", kMismatch,
           [](const Image& depth, std::size_t) { return flipped(depth, -1); }),
      {"depth_of_others", kDepth, "the depth images are in random order", kMismatch,
       with_depth_of_others},
      each("depth_shifted", "the depth image is 8 % of its width beside its place", kMismatch,
           [](const Image& depth, std::size_t) {
             return shifted(depth, 0.08 * depth.cols, 0, cv::INTER_NEAREST);
           }),
  };
}

std::vector<Fault> faults_of_values() {
  return {
      unit("depth_unit_1000", "the unit is stated as metres, steps are millimetres", 1000),
      unit("depth_unit_5", "1000 steps are stated as a metre, 5000 are", 5),
      unit("depth_unit_tenth_more", "the unit is stated 10 % too large", 1.1),
      each("depth_constant", "the depth is 2 m everywhere", kMismatch,
           [](const Image& depth, std::size_t) {
             return Image(depth.size(), CV_32FC1, cv::Scalar(2));
           }),
      {"depth_holes", kDepth, "half of the depth image has no measurement", "-",
       [](const Recording& r, std::uint32_t seed) {
         return with_depth(r, whole(r), [seed](const Image& depth, std::size_t index) {
           return with_holes(depth, seed, index);
         });
       }},
      each("depth_none", "no depth is measured", "depth_mismatch|few_posed|lost_frames",
           [](const Image& depth, std::size_t) {
             return Image(Image::zeros(depth.size(), CV_32FC1));
           }),
      {"depth_none_while", kDepth, "no depth is measured for three tenths of the frames", "-",
       [](const Recording& r, std::uint32_t) {
         return with_depth(r, part(r, 0.4, 0.7), [](const Image& depth, std::size_t) {
           return Image(Image::zeros(depth.size(), CV_32FC1));
         });
       }},
      {"depth_noise", kDepth, "depth has noise of 10 %", kMismatch,
       [](const Recording& r, std::uint32_t seed) {
         return with_depth(r, whole(r), [seed](const Image& depth, std::size_t index) {
           return with_depth_noise(depth, 0.1, seed, index);
         });
       }},
      each("depth_offset", "half a metre is added to all depths",
           "depth_mismatch|depth_unit_questionable|scale_questionable",
           [](const Image& depth, std::size_t) { return with_offset(depth, 0.5); }),
  };
}

}  // namespace

std::vector<Fault> depth_faults() {
  std::vector<Fault> faults = faults_of_pairing();
  const std::vector<Fault> more = faults_of_values();
  faults.insert(faults.end(), more.begin(), more.end());
  return faults;
}

}  // namespace placegraph::faults
