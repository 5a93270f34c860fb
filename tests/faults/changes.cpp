#include "tests/faults/changes.h"

#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph::faults {
namespace {

Recording with(const Recording& recording, Span span, const std::vector<Image Frame::*>& members,
               const ImageChange& change) {
  Recording out = recording;
  out.faulty = span;
  for (std::size_t i = span.first; i <= span.last && i < out.size(); ++i)
    for (const auto member : members)
      if (!(out.frames[i].*member).empty())
        out.frames[i].*member = change(recording.frames[i].*member, i);
  return out;
}

/// The frames with these numbers, with their truth and their own stamps.
Recording selected(const Recording& recording, const std::vector<std::size_t>& numbers) {
  require(!numbers.empty(), "the recording is too short for this fault");
  Recording out = recording;
  out.frames.clear();
  out.T_world_cam.clear();
  for (const std::size_t number : numbers) {
    out.frames.push_back(recording.frames.at(number));
    if (!recording.T_world_cam.empty()) out.T_world_cam.push_back(recording.T_world_cam[number]);
  }
  out.faulty = {0, numbers.size() - 1};
  return out;
}

}  // namespace

cv::RNG random_of(std::uint32_t seed, std::size_t index) {
  // The mixing function of SplitMix64 (Steele et al. 2014).
  std::uint64_t state = seed * 7919ULL + index + 0x9e3779b97f4a7c15ULL;
  state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9ULL;
  state = (state ^ (state >> 27)) * 0x94d049bb133111ebULL;
  return cv::RNG(state ^ (state >> 31));
}

Span whole(const Recording& recording) { return {0, recording.size() - 1}; }

Span part(const Recording& recording, double from, double to) {
  const double size = static_cast<double>(recording.size());
  const auto first = static_cast<std::size_t>(from * size);
  const auto end = static_cast<std::size_t>(to * size);
  return {std::min(first, recording.size() - 1), std::max(first, end > 0 ? end - 1 : 0)};
}

Span middle(const Recording& recording, std::size_t count) {
  const std::size_t size = recording.size(), length = std::min(count, size);
  return {(size - length) / 2, (size - length) / 2 + length - 1};
}

Recording with_images(const Recording& recording, Span span, const ImageChange& change) {
  return with(recording, span, {&Frame::image, &Frame::right}, change);
}

Recording with_right(const Recording& recording, Span span, const ImageChange& change) {
  return with(recording, span, {&Frame::right}, change);
}

Recording with_depth(const Recording& recording, Span span, const ImageChange& change) {
  return with(recording, span, {&Frame::depth}, change);
}

Recording with_kept(const Recording& recording, const std::vector<std::size_t>& numbers) {
  require(std::is_sorted(numbers.begin(), numbers.end()), "numbers of kept frames must ascend");
  return selected(recording, numbers);
}

Recording with_order(const Recording& recording, const std::vector<std::size_t>& numbers) {
  Recording out = selected(recording, numbers);
  const std::int64_t distance_ns = median_distance_ns(recording);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t at = std::min(i, recording.size() - 1);
    out.frames[i].stamp_ns =
        recording.frames[at].stamp_ns + static_cast<std::int64_t>(i - at) * distance_ns;
  }
  return out;
}

std::int64_t median_distance_ns(const Recording& recording) {
  std::vector<std::int64_t> distances;
  for (std::size_t i = 1; i < recording.size(); ++i)
    distances.push_back(recording.frames[i].stamp_ns - recording.frames[i - 1].stamp_ns);
  if (distances.empty()) return 100000000;
  const auto half = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), half, distances.end());
  return *half;
}

Image shifted(const Image& image, double du, double dv, int interpolation) {
  Eigen::Matrix3d H_source_result = Eigen::Matrix3d::Identity();
  H_source_result(0, 2) = -du;
  H_source_result(1, 2) = -dv;
  return warped(image, H_source_result, interpolation);
}

Image warped(const Image& image, const Eigen::Matrix3d& H_source_result, int interpolation) {
  cv::Mat H(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      H.at<double>(row, column) = H_source_result(row, column);
  Image out;
  cv::warpPerspective(image, out, H, image.size(), interpolation | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  return out;
}

}  // namespace placegraph::faults
