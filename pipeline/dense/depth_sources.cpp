#include <placegraph/frontend/floor_plan/plan_surfaces.h>
#include <placegraph/frontend/floor_plan/plane_sweep.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/dense/depth_sources.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <opencv2/imgproc.hpp>
#include <unordered_map>

namespace placegraph {
namespace {

/// The colours of an image, or its grey values.
Image colours_of(const Frame& frame) {
  if (!frame.colour.empty()) return frame.colour;
  Image colour;
  cv::cvtColor(frame.image, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

/// What the sources have in common: keyframes whose images are read on demand.
class DepthFromImages : public DepthOfKeyframe {
 public:
  explicit DepthFromImages(PosedImages images) : images_(std::move(images)) {}
  std::size_t size() const override { return images_.keyframes.size(); }

 protected:
  const SE3& T_map_cam(std::size_t index) const { return images_.keyframes[index].T_map_cam; }
  Frame frame(std::size_t index) const {
    return images_.frame_of(*images_.keyframes[index].keyframe);
  }
  const Calibration& calibration() const { return images_.calibration; }

 private:
  PosedImages images_;
};

class SensorDepth final : public DepthFromImages {
 public:
  using DepthFromImages::DepthFromImages;
  KeyframeDepth of(std::size_t index) override {
    const DepthCamera& sensor = calibration().depth.value();
    const Frame images = frame(index);
    KeyframeDepth result;
    result.camera = sensor.camera;
    result.T_map_cam = T_map_cam(index) * sensor.T_cam_depth;
    result.depth = images.depth.clone();
    result.sigma_inverse = Image(result.depth.size(), CV_32FC1, cv::Scalar(sensor.sigma_at_1m));
    result.colour = colours_at(result.depth, sensor, colours_of(images));
    return result;
  }

 private:
  /// The colours of the depth image's pixels, black where the other camera does not see them.
  Image colours_at(const Image& depth, const DepthCamera& sensor, const Image& colour) const {
    Image result(depth.size(), CV_8UC3, cv::Scalar(0, 0, 0));
    const Camera& from = sensor.camera;
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) {
        const double z = depth.at<float>(v, u);
        if (!(z > 0)) continue;
        const auto px = calibration().camera.project(
            sensor.T_cam_depth *
            Eigen::Vector3d(z * (u - from.cx) / from.fx, z * (v - from.cy) / from.fy, z));
        if (px && calibration().camera.contains(*px))
          result.at<cv::Vec3b>(v, u) = colour.at<cv::Vec3b>(
              static_cast<int>(std::lround((*px)[1])), static_cast<int>(std::lround((*px)[0])));
      }
    return result;
  }
};

class StereoDepth final : public DepthFromImages {
 public:
  StereoDepth(PosedImages images, const DepthRange& range) : DepthFromImages(std::move(images)) {
    // OpenCV needs multiples of 16; the range is bounded by the cost. Chosen.
    constexpr int kStep = 16, kFewest = 32, kMost = 256;
    const double nearest = 2 * calibration().camera.fx * calibration().baseline_m / range.near;
    const double steps = std::ceil(std::clamp(nearest, 1.0 * kFewest, 1.0 * kMost) / kStep);
    options_.disparities = kStep * static_cast<int>(steps);
    options_.window_px = 5;
  }
  KeyframeDepth of(std::size_t index) override {
    constexpr double kSigma_px = 0.3;  // standard deviation of a disparity
    const double focal_baseline = calibration().camera.fx * calibration().baseline_m;
    const Frame images = frame(index);
    KeyframeDepth result;
    result.camera = calibration().camera;
    result.T_map_cam = T_map_cam(index);
    result.depth = dense_stereo(images.image, images.right, calibration().camera.fx,
                                calibration().baseline_m, options_);
    result.sigma_inverse =
        Image(result.depth.size(), CV_32FC1, cv::Scalar(kSigma_px / focal_baseline));
    result.colour = colours_of(images);
    return result;
  }

 private:
  DenseStereoOptions options_;
};

class SweepDepth final : public DepthFromImages {
 public:
  SweepDepth(PosedImages images, const DepthRange& range)
      : DepthFromImages(std::move(images)), median_(range.median) {
    // The sweep's options are in metres: its unit is a tenth of the median depth.
    constexpr double kNearest_m = 0.1, kFarthest_m = 1000;  // a hundredth and 100 of the median
    options_.min_depth_m = std::max(0.5 * range.near / unit(), kNearest_m);
    options_.max_depth_m = std::min(2 * range.far / unit(), kFarthest_m);
    // Larger images are halved: the cost of the sweep. Chosen.
    constexpr int kMostPixels = 150'000;
    int width = calibration().camera.width, height = calibration().camera.height;
    while (width * height > kMostPixels) width /= 2, height /= 2;
    options_.max_width_px = std::max(width, 32);
  }
  KeyframeDepth of(std::size_t index) override {
    std::vector<SweptView> views;
    for (const int direction : {-1, 1})
      for (const std::size_t other : views_towards(index, direction))
        views.push_back({frame_at(other).image,
                         (T_map_cam(other).inverse() * T_map_cam(index)).scaled(1 / unit())});
    const Frame& images = frame_at(index);
    SweptDepth swept = sweep_planes(images.image, calibration().camera, views, options_);
    KeyframeDepth result;
    result.camera = swept.camera;
    result.T_map_cam = T_map_cam(index);
    result.depth = unit() * swept.depth_m;
    result.sigma_inverse = swept.sigma_inverse / unit();
    cv::resize(colours_of(images), result.colour, result.depth.size(), 0, 0, cv::INTER_AREA);
    return result;
  }

 private:
  static constexpr int kFarthest = 10;  ///< keyframes before or after

  double unit() const { return median_ / 10; }

  /// The keyframes on one side whose images are compared.
  std::vector<std::size_t> views_towards(std::size_t index, int direction) const {
    constexpr double kNear = 0.05, kFar = 0.15, kMost = 0.3;  // shares of the median depth
    const double most_rad = deg_to_rad(20);
    std::vector<std::size_t> views;
    double wanted = kNear;
    for (int step = 1; step <= kFarthest; ++step) {
      const auto other = static_cast<std::ptrdiff_t>(index) + direction * step;
      if (other < 0 || other >= static_cast<std::ptrdiff_t>(size())) break;
      const SE3 T = T_map_cam(static_cast<std::size_t>(other)).inverse() * T_map_cam(index);
      const double moved = T.translation().norm() / median_;
      if (T.rotation().log().norm() > most_rad || moved > kMost) break;
      if (moved < wanted) continue;
      views.push_back(static_cast<std::size_t>(other));
      if (moved >= kFar) break;
      wanted = kFar;
    }
    return views;
  }
  /// The images of a keyframe; the last ones are kept.
  const Frame& frame_at(std::size_t index) {
    for (const auto& [number, frame] : read_)
      if (number == index) return frame;
    if (read_.size() > 2 * kFarthest + 1) read_.pop_front();
    return read_.emplace_back(index, frame(index)).second;
  }

  double median_;
  PlaneSweepOptions options_;
  std::deque<std::pair<std::size_t, Frame>> read_;
};

}  // namespace

DepthRange depth_range_of(const MapGeometry& geometry) {
  std::unordered_map<LandmarkId, const Eigen::Vector3d*> points;
  for (const PlacedLandmark& landmark : geometry.landmarks)
    points.emplace(landmark.id, &landmark.p_map);
  std::vector<double> depths;
  for (const PosedKeyframe& posed : geometry.keyframes) {
    const SE3 T_cam_map = posed.T_map_cam.inverse();
    for (const LandmarkObservation& seen : posed.keyframe->observations)
      if (const auto point = points.find(seen.landmark); point != points.end())
        if (const double z = (T_cam_map * *point->second)[2]; z > 0) depths.push_back(z);
  }
  if (depths.empty()) return {};
  std::ranges::sort(depths);
  const auto at = [&](double share) {
    return depths[static_cast<std::size_t>(share * static_cast<double>(depths.size() - 1))];
  };
  return {at(0.02), at(0.5), at(0.98)};
}

std::unique_ptr<DepthOfKeyframe> depth_by_sensor(PosedImages images) {
  require(images.calibration.depth.has_value(), "depth by sensor: needs a depth camera");
  return std::make_unique<SensorDepth>(std::move(images));
}

std::unique_ptr<DepthOfKeyframe> depth_by_stereo(PosedImages images, const DepthRange& range) {
  require(images.calibration.baseline_m > 0 && range.near > 0,
          "depth by stereo: needs a baseline and a range of depths");
  return std::make_unique<StereoDepth>(std::move(images), range);
}

std::unique_ptr<DepthOfKeyframe> depth_by_sweep(PosedImages images, const DepthRange& range) {
  require(range.near > 0, "depth by sweep: needs a range of depths");
  return std::make_unique<SweepDepth>(std::move(images), range);
}

}  // namespace placegraph
