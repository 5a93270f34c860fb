#include <placegraph/frontend/scene/moving_classes.h>
#include <placegraph/frontend/scene/street_labelling.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum disparity between a point and the surface behind it. Chosen.
constexpr double kMinThroughDisparity_px = 2;
/// Radius within which all depths must be farther. Chosen.
constexpr int kThroughRadius_px = 2;

/// Maximum distance of a disparity from its superpixel's plane [sigma]. Chosen: 99.7 %
/// of a normal distribution lie within it.
constexpr double kMaxPlaneResidual = 3;

/// Every `step`-th pixel that has a depth up to `farthest`.
std::vector<DepthSample> sample_depth(const Image& depth_m, const Camera& camera,
                                      const Superpixels& superpixels, int step, double farthest) {
  std::vector<DepthSample> samples;
  for (int v = step / 2; v < depth_m.rows; v += step)
    for (int u = step / 2; u < depth_m.cols; u += step) {
      const float z = depth_m.at<float>(v, u);
      if (!(z > 0) || static_cast<double>(z) > farthest) continue;
      DepthSample sample;
      sample.u = static_cast<float>(u), sample.v = static_cast<float>(v);
      sample.point = {static_cast<float>((u - camera.cx) / camera.fx) * z,
                      static_cast<float>((v - camera.cy) / camera.fy) * z, z};
      sample.superpixel = superpixels.index.at<int>(v * superpixels.rows / depth_m.rows,
                                                    u * superpixels.cols / depth_m.cols);
      samples.push_back(sample);
    }
  return samples;
}

}  // namespace

StreetLabelling see_street(const Image& picture, const Image& depth_m, const Camera& camera,
                           double baseline_m, double camera_height_m, const SceneModel& urban,
                           const SceneModel& surfaces, const StreetLabellingOptions& options) {
  options.check();
  require(
      depth_m.type() == CV_32FC1 && depth_m.size() == picture.size() &&
          picture.cols == camera.width && picture.rows == camera.height && baseline_m > 0,
      "see_street: needs an image and its CV_32FC1 depths, of the camera's size, and a baseline");
  const std::vector<bool> moving = moving_classes(options.moving, urban);
  const double disparity_m_px = camera.fx * baseline_m;
  StreetLabelling seen;
  seen.view = view_scene(picture);
  const auto regions = static_cast<std::size_t>(seen.view.superpixels.count);
  LabellerOptions alone = options.labeller;
  alone.field = false;
  seen.labels = label_jointly(urban, surfaces, seen.view, alone);
  const std::vector<DepthSample> samples =
      sample_depth(depth_m, camera, seen.view.superpixels, options.step_px, options.max_range_m);
  std::vector<float> ground(regions);
  for (std::size_t i = 0; i < regions; ++i)
    ground[i] =
        seen.labels.surfaces[i * kSurfaceCount + static_cast<std::size_t>(Surface::kGround)];
  seen.ground = fit_ground(samples, ground, camera_height_m);
  const std::vector<RegionPlace> places =
      place_regions(samples, seen.view.superpixels.count, camera, disparity_m_px, seen.ground);
  const std::size_t n = urban.classes.size();
  const bool known = seen.ground.outcome || camera_height_m > 0;
  seen.labels = join_evidence(urban, seen.labels, seen.view,
                              known ? geometry_log_likelihoods(places, urban, options.geometry)
                                    : std::vector<float>(regions * n, 0.0F),
                              options.labeller);

  seen.observation.shares = seen.labels.classes;
  seen.observation.down = seen.ground.down.cast<float>();
  std::vector<bool> kept(regions);
  for (std::size_t i = 0; i < regions; ++i) {
    const float* p = seen.labels.classes.data() + i * n;
    const auto best = static_cast<std::size_t>(std::max_element(p, p + n) - p);
    kept[i] = !moving[best] && urban.surfaces[best] != Surface::kSky;
  }
  for (const DepthSample& sample : samples) {
    const auto region = static_cast<std::size_t>(sample.superpixel);
    if (!kept[region]) continue;
    const RegionPlace& place = places[region];
    const Eigen::Vector3d p = sample.point.cast<double>();
    if (place.plane.isZero()) continue;  // too few depths around it for a reliable one
    const double off = disparity_m_px / p[2] * std::abs(1 - place.plane.dot(p));
    if (off > kMaxPlaneResidual * place.disparity_sigma_px) continue;
    StreetPoint point;
    point.point = sample.point;
    point.sigma = static_cast<float>(p[2] * p[2] * place.disparity_sigma_px / disparity_m_px);
    point.height_m = static_cast<float>(seen.ground.height_of(p));
    point.region = static_cast<std::uint16_t>(region);
    seen.observation.points.push_back(point);
  }
  return seen;
}

std::vector<bool> seen_through(const std::vector<StreetPoint>& points, const SE3& T_other_cam,
                               const Image& depth_m, const Camera& camera, double baseline_m) {
  require(depth_m.type() == CV_32FC1 && depth_m.cols == camera.width &&
              depth_m.rows == camera.height && baseline_m > 0,
          "seen_through: needs a CV_32FC1 depth image of the camera's size, and a baseline");
  const double disparity_m_px = camera.fx * baseline_m;
  std::vector<bool> through(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = T_other_cam * points[i].point.cast<double>();
    if (p[2] < 0.5) continue;
    const int u = static_cast<int>(std::lround(camera.fx * p[0] / p[2] + camera.cx));
    const int v = static_cast<int>(std::lround(camera.fy * p[1] / p[2] + camera.cy));
    const int r = kThroughRadius_px;
    if (u < r || v < r || u + r >= depth_m.cols || v + r >= depth_m.rows) continue;
    // Disparity error of the point in this image, from the uncertainty of the first one.
    const double sigma_px = static_cast<double>(points[i].sigma) * disparity_m_px / (p[2] * p[2]);
    const double limit = disparity_m_px / p[2] - std::max(kMinThroughDisparity_px, 3 * sigma_px);
    int seen = 0, farther = 0;
    for (int y = v - r; y <= v + r; ++y)
      for (int x = u - r; x <= u + r; ++x) {
        const float z = depth_m.at<float>(y, x);
        if (!(z > 0)) continue;
        ++seen;
        farther += disparity_m_px / static_cast<double>(z) < limit ? 1 : 0;
      }
    through[i] = 2 * seen > (2 * r + 1) * (2 * r + 1) && farther == seen;
  }
  return through;
}

}  // namespace placegraph
