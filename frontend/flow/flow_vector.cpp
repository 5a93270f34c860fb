#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <limits>

namespace placegraph {

Image flow_image(const std::vector<FlowVector>& vectors, int width, int height) {
  Image image(height, width, CV_32FC2, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
  for (const FlowVector& vector : vectors) {
    if (vector.kind != FlowVector::Kind::kFull) continue;
    const auto u = static_cast<int>(std::lround(vector.px.x()));
    const auto v = static_cast<int>(std::lround(vector.px.y()));
    if (u < 0 || v < 0 || u >= width || v >= height) continue;
    image.at<cv::Vec2f>(v, u) = {static_cast<float>(vector.flow.x()),
                                 static_cast<float>(vector.flow.y())};
  }
  return image;
}

std::vector<Eigen::Vector2d> flow_grid(int width, int height, int step_px) {
  require(step_px > 0, "flow_grid: the step must be positive");
  std::vector<Eigen::Vector2d> points;
  for (int v = step_px / 2; v < height; v += step_px)
    for (int u = step_px / 2; u < width; u += step_px) points.emplace_back(u, v);
  return points;
}

}  // namespace placegraph
