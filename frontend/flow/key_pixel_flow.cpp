#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>
#include <opencv2/core/hal/hal.hpp>
#include <opencv2/features2d.hpp>

namespace placegraph {
namespace {

struct KeyPixels {
  std::vector<cv::KeyPoint> points;
  Image descriptors;  // CV_32FC1, one row per key-pixel
};

KeyPixels find(const Image& image, const KeyPixelFlowOptions& options) {
  KeyPixels found;
  cv::SIFT::create(options.max_key_pixels)
      ->detectAndCompute(image, cv::noArray(), found.points, found.descriptors);
  return found;
}

bool comparable(const cv::KeyPoint& a, const cv::KeyPoint& b, const KeyPixelFlowOptions& options) {
  const cv::Point2f flow = b.pt - a.pt;
  return flow.dot(flow) <= options.max_flow_px * options.max_flow_px &&
         std::max(a.size, b.size) <= options.max_scale_ratio * std::min(a.size, b.size);
}

/// Index of the best partner in `b` of every key-pixel of `a`, -1 if none is clearly better than
/// the next.
std::vector<int> best_partners(const KeyPixels& a, const KeyPixels& b,
                               const KeyPixelFlowOptions& options) {
  std::vector<int> partners;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    float best = std::numeric_limits<float>::infinity(), second = best;
    int partner = -1;
    for (std::size_t j = 0; j < b.points.size(); ++j) {
      if (!comparable(a.points[i], b.points[j], options)) continue;
      const float distance =
          cv::hal::normL2Sqr_(a.descriptors.ptr<float>(static_cast<int>(i)),
                              b.descriptors.ptr<float>(static_cast<int>(j)), a.descriptors.cols);
      if (distance < best) {
        // A blob may have two descriptors, one for each strong orientation: they are not rivals.
        if (partner < 0 || b.points[j].pt != b.points[partner].pt) second = best;
        best = distance;
        partner = static_cast<int>(j);
      } else if (distance < second && b.points[j].pt != b.points[partner].pt) {
        second = distance;
      }
    }
    const auto limit = static_cast<float>(options.max_ratio * options.max_ratio);
    partners.push_back(best < limit * second ? partner : -1);
  }
  return partners;
}

}  // namespace

std::vector<FlowVector> key_pixel_flow(const Image& from, const Image& to,
                                       const KeyPixelFlowOptions& options) {
  options.check();
  require(from.type() == CV_8UC1 && !from.empty() && to.type() == CV_8UC1,
          "key_pixel_flow: grey images are needed");
  require(from.size() == to.size(), "key_pixel_flow: the images differ in size");
  const KeyPixels a = find(from, options), b = find(to, options);
  const std::vector<int> there = best_partners(a, b, options), back = best_partners(b, a, options);
  std::vector<FlowVector> flow;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (there[i] < 0) continue;
    const cv::KeyPoint &start = a.points[i], &end = b.points[static_cast<std::size_t>(there[i])];
    const int home = back[static_cast<std::size_t>(there[i])];
    if (home < 0 || a.points[static_cast<std::size_t>(home)].pt != start.pt) continue;
    if (!flow.empty() && flow.back().px == Eigen::Vector2d(start.pt.x, start.pt.y)) continue;
    FlowVector vector;
    vector.kind = FlowVector::Kind::kFull;
    vector.px = {start.pt.x, start.pt.y};
    vector.flow = Eigen::Vector2d(end.pt.x, end.pt.y) - vector.px;
    const double sigma_px = 0.05 * start.size;  // a fortieth of the blob's diameter in each image
    vector.covariance = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
    flow.push_back(vector);
  }
  return flow;
}

}  // namespace placegraph
