#include <placegraph/frontend/features/detector.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>

namespace placegraph {
namespace {

/// The strongest features of every cell, so that one textured region does not take all.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> candidates, cv::Size size, int count) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.response > b.response; });
  if (static_cast<int>(candidates.size()) <= count) return candidates;
  const int cell_px = std::max(16, static_cast<int>(std::sqrt(size.area() / (count / 3.0))));
  const int columns = size.width / cell_px + 1, rows = size.height / cell_px + 1;
  std::vector<int> rank_in_cell(columns * rows, 0);
  std::vector<std::pair<int, int>> order;  // rank in its cell, index
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    const int cell = static_cast<int>(candidates[i].pt.y) / cell_px * columns +
                     static_cast<int>(candidates[i].pt.x) / cell_px;
    order.emplace_back(rank_in_cell[cell]++, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<cv::KeyPoint> kept;
  for (int i = 0; i < count; ++i) kept.push_back(candidates[order[i].second]);
  return kept;
}

}  // namespace

std::vector<Feature> detect_features(const Image& image, const DetectorOptions& options,
                                     const Image& mask) {
  require(image.type() == CV_8UC1, "detect_features: grey image needed");
  const auto orb =
      cv::ORB::create(2 * options.max_features, static_cast<float>(options.scale_factor),
                      options.octaves, 19, 0, 2, cv::ORB::HARRIS_SCORE, 31, options.fast_threshold);
  std::vector<cv::KeyPoint> keypoints;
  orb->detect(image, keypoints, mask);
  keypoints = spread(std::move(keypoints), image.size(), options.max_features);
  cv::Mat descriptors;
  orb->compute(image, keypoints, descriptors);

  std::vector<Feature> features(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    features[i].px = {keypoints[i].pt.x, keypoints[i].pt.y};
    features[i].angle_rad = static_cast<float>(deg_to_rad(keypoints[i].angle));
    features[i].octave = keypoints[i].octave;
    std::memcpy(features[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)),
                sizeof(BinaryDescriptor));
  }
  return features;
}

}  // namespace placegraph
