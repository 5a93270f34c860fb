#include <placegraph/frontend/flow/horn_schunck.h>
#include <placegraph/frontend/flow/interpolation_flow.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace placegraph {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

Image opencv_lucas_kanade(const Image& from, const Image& to, const FlowOptions& options) {
  const LucasKanadeOptions& lk = options.lucas_kanade;
  std::vector<cv::Point2f> start, end, home;
  for (const Eigen::Vector2d& px : flow_grid(from.cols, from.rows, options.step_px))
    start.emplace_back(static_cast<float>(px.x()), static_cast<float>(px.y()));
  const cv::Size window(lk.window_px, lk.window_px);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, lk.iterations,
                              lk.epsilon_px);
  std::vector<Image> a, b;
  cv::buildOpticalFlowPyramid(from, a, window, lk.levels - 1);
  cv::buildOpticalFlowPyramid(to, b, window, lk.levels - 1);
  // OpenCV's eigenvalues are those of gradients in grey levels, divided by 1024.
  const double min_eigenvalue = lk.min_eigenvalue * 255 * 255 / 1024;
  std::vector<unsigned char> there, back;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(a, b, start, end, there, error, window, lk.levels - 1, stop, 0,
                           min_eigenvalue);
  if (lk.max_return_error_px > 0) {
    home = start;
    cv::calcOpticalFlowPyrLK(b, a, end, home, back, error, window, lk.levels - 1, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW, min_eigenvalue);
  }
  std::vector<FlowVector> flow;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!there[i] || (!home.empty() && !back[i])) continue;
    if (!home.empty() && cv::norm(home[i] - start[i]) > lk.max_return_error_px) continue;
    if (end[i].x < 0 || end[i].y < 0 || end[i].x > static_cast<float>(from.cols - 1) ||
        end[i].y > static_cast<float>(from.rows - 1))
      continue;
    FlowVector vector;
    vector.kind = FlowVector::Kind::kFull;
    vector.px = {start[i].x, start[i].y};
    vector.flow = {end[i].x - start[i].x, end[i].y - start[i].y};
    flow.push_back(vector);
  }
  return flow_image(flow, from.cols, from.rows);
}

/// Invalidates flow that leaves the image.
Image forget_outside(Image flow) {
  for (int v = 0; v < flow.rows; ++v) {
    for (int u = 0; u < flow.cols; ++u) {
      cv::Vec2f& d = flow.at<cv::Vec2f>(v, u);
      const float x = static_cast<float>(u) + d[0], y = static_cast<float>(v) + d[1];
      if (!(x >= 0 && y >= 0 && x <= static_cast<float>(flow.cols - 1) &&
            y <= static_cast<float>(flow.rows - 1)))
        d = {kUnknown, kUnknown};
    }
  }
  return flow;
}

Image farneback(const Image& from, const Image& to) {
  Image flow;
  cv::calcOpticalFlowFarneback(from, to, flow, 0.5, 5, 15, 5, 7, 1.5, 0);
  return forget_outside(flow);
}

Image dis(const Image& from, const Image& to) {
  Image flow;
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(from, to, flow);
  return forget_outside(flow);
}

}  // namespace

Image optical_flow(const Image& from, const Image& to, const FlowOptions& options) {
  options.check();
  require(from.type() == CV_8UC1 && !from.empty() && to.type() == CV_8UC1,
          "optical_flow: grey images are needed");
  require(from.size() == to.size(), "optical_flow: the images differ in size");
  const auto grid = [&] { return flow_grid(from.cols, from.rows, options.step_px); };
  const auto image = [&](const std::vector<FlowVector>& vectors) {
    return flow_image(vectors, from.cols, from.rows);
  };
  switch (options.method) {
    case FlowMethod::kInterpolation:
      return image(interpolation_flow(from, to, grid(), options.interpolation));
    case FlowMethod::kLucasKanade:
      return image(lucas_kanade(from, to, grid(), options.lucas_kanade));
    case FlowMethod::kHornSchunck:
      return horn_schunck(from, to, options.horn_schunck);
    case FlowMethod::kKeyPixels:
      return image(key_pixel_flow(from, to, options.key_pixels));
    case FlowMethod::kOpencvLucasKanade:
      return opencv_lucas_kanade(from, to, options);
    case FlowMethod::kFarneback:
      return farneback(from, to);
    case FlowMethod::kDis:
      return dis(from, to);
  }
  throw ArgumentError("optical_flow: unknown method");
}

}  // namespace placegraph
