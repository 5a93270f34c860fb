#include <placegraph/eval/scene/flow_error.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace placegraph {

FlowError flow_error(const Image& flow, const Image& truth, const FlowRange& range) {
  require(flow.type() == CV_32FC2 && truth.type() == CV_32FC2,
          "flow_error: flow has two channels of floats");
  require(flow.size() == truth.size(), "flow_error: the sizes differ");
  FlowError result;
  std::vector<double> errors;
  for (int v = 0; v < truth.rows; ++v) {
    for (int u = 0; u < truth.cols; ++u) {
      const cv::Vec2f &d = flow.at<cv::Vec2f>(v, u), &t = truth.at<cv::Vec2f>(v, u);
      const double end_u = u + t[0], end_v = v + t[1];
      if (!(end_u >= 0 && end_v >= 0 && end_u <= truth.cols - 1 && end_v <= truth.rows - 1))
        continue;
      const double length = std::hypot(t[0], t[1]);
      if (length < range.min_px || length >= range.max_px) continue;
      ++result.pixels;
      const double error = std::hypot(d[0] - t[0], d[1] - t[1]);
      if (!std::isfinite(error)) continue;
      errors.push_back(error);
      result.mean_px += error;
      if (error > 3) result.share_beyond_3px += 1;
    }
  }
  result.compared = static_cast<std::int64_t>(errors.size());
  if (result.pixels)
    result.coverage = static_cast<double>(result.compared) / static_cast<double>(result.pixels);
  if (errors.empty()) return result;
  const auto n = static_cast<double>(errors.size());
  result.mean_px /= n;
  result.share_beyond_3px /= n;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  result.median_px = *middle;
  return result;
}

}  // namespace placegraph
