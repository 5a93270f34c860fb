#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/camera_change.h>
#include <placegraph/io/calibration/rectification.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

bool same(const Camera& a, const Camera& b) {
  const auto equal = [](double x, double y) {
    return std::abs(x - y) <= 1e-6 * std::max(std::abs(x), std::abs(y));
  };
  return a.width == b.width && a.height == b.height && equal(a.fx, b.fx) && equal(a.fy, b.fy) &&
         equal(a.cx, b.cx) && equal(a.cy, b.cy);
}

void require_pinhole(const Camera& camera) {
  camera.check();
  require(camera.distortion == Distortion::kNone, "camera change: a camera has distortion");
}

}  // namespace

CameraChange::CameraChange(const Camera& from, const Camera& to) {
  require_pinhole(from);
  require_pinhole(to);
  if (same(from, to)) return;
  Remap remap;
  remap.map_x.create(to.height, to.width, CV_32FC1);
  remap.map_y.create(to.height, to.width, CV_32FC1);
  seen_.create(to.height, to.width, CV_8UC1);
  for (int v = 0; v < to.height; ++v)
    for (int u = 0; u < to.width; ++u) {
      const double x = from.fx * (u - to.cx) / to.fx + from.cx;
      const double y = from.fy * (v - to.cy) / to.fy + from.cy;
      remap.map_x.at<float>(v, u) = static_cast<float>(x);
      remap.map_y.at<float>(v, u) = static_cast<float>(y);
      seen_.at<std::uint8_t>(v, u) = from.contains({x, y}) ? 255 : 0;
    }
  remap_ = std::make_shared<const Remap>(std::move(remap));
  seen_share_ = cv::countNonZero(seen_) / static_cast<double>(seen_.total());
  // The patch of a feature's descriptor must be within the visible part; the border of the image
  // itself counts as in any image.
  constexpr int kPatchPx = 31;
  cv::erode(seen_, seen_, cv::Mat::ones(kPatchPx, kPatchPx, CV_8UC1));
  const double shrinks = std::sqrt(from.fx * from.fy / (to.fx * to.fy));
  if (shrinks > 1) blur_sigma_px_ = 0.5 * std::sqrt(shrinks * shrinks - 1);
}

void CameraChange::apply(Frame& frame) const {
  if (is_identity()) return;
  const auto resampled = [this](const Image& image) {
    if (image.empty() || blur_sigma_px_ == 0)
      return image.empty() ? image : remap_->bilinear(image);
    Image smooth;
    cv::GaussianBlur(image, smooth, {}, blur_sigma_px_);
    return remap_->bilinear(smooth);
  };
  frame.image = resampled(frame.image);
  frame.colour = resampled(frame.colour);
  frame.mask = frame.mask.empty() ? seen_ : Image(remap_->nearest(frame.mask) & seen_);
  frame.right = frame.depth = Image();
}

}  // namespace placegraph
