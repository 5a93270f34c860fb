#include <placegraph/frontend/internal/features/depth_lookup.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <limits>

namespace placegraph {

std::vector<std::optional<double>> lookup_depth(const Image& depth_m, const Camera& camera,
                                                const DepthCamera& depth_camera,
                                                const std::vector<Eigen::Vector2f>& px,
                                                const DepthLookupOptions& options) {
  require(depth_m.type() == CV_32FC1, "lookup_depth: depth image in metres (CV_32FC1) needed");
  // The depth image reprojected into the colour camera, nearest surface first.
  cv::Mat registered(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
  const Camera& d = depth_camera.camera;
  const Eigen::Matrix3d R = depth_camera.T_cam_depth.rotation().matrix();
  const Eigen::Vector3d& t = depth_camera.T_cam_depth.translation();
  for (int v = 0; v < depth_m.rows; ++v) {
    const float* row = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      const double z = row[u];
      if (!(z > 0)) continue;
      const Eigen::Vector3d p =
          R * Eigen::Vector3d((u - d.cx) / d.fx * z, (v - d.cy) / d.fy * z, z) + t;
      if (p.z() <= 0) continue;
      const double u_cam = camera.fx * p.x() / p.z() + camera.cx;
      const double v_cam = camera.fy * p.y() / p.z() + camera.cy;
      if (!(u_cam > -0.5 && v_cam > -0.5 && u_cam < camera.width - 0.5 &&
            v_cam < camera.height - 0.5))
        continue;
      float& cell =
          registered.at<float>(static_cast<int>(v_cam + 0.5), static_cast<int>(u_cam + 0.5));
      if (cell == 0 || p.z() < cell) cell = static_cast<float>(p.z());
    }
  }
  std::vector<std::optional<double>> depths(px.size());
  const double margin_px = std::max(std::min(options.radius_px, options.margin_px),
                                    options.margin_px * (camera.fx / options.margin_focal_px));
  const int reach = static_cast<int>(std::ceil(margin_px));
  for (std::size_t i = 0; i < px.size(); ++i) {
    const int u0 = cvRound(px[i].x()), v0 = cvRound(px[i].y());
    double sum = 0, weight = 0;
    float nearest = std::numeric_limits<float>::max(), farthest = 0;
    for (int v = std::max(0, v0 - reach); v <= std::min(camera.height - 1, v0 + reach); ++v)
      for (int u = std::max(0, u0 - reach); u <= std::min(camera.width - 1, u0 + reach); ++u) {
        const float z = registered.at<float>(v, u);
        const double distance = std::hypot(u - px[i].x(), v - px[i].y());
        if (z == 0 || distance > margin_px) continue;
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
        if (distance > options.radius_px) continue;
        const double w = 1 / (0.5 + distance);
        sum += w * z;
        weight += w;
      }
    if (weight > 0 && farthest - nearest < options.max_spread * nearest) depths[i] = sum / weight;
  }
  return depths;
}

}  // namespace placegraph
