#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace placegraph {

namespace {

/// The depth image reprojected into the colour camera, nearest surface first.
Image registered_depth(const Image& depth_m, const Camera& camera,
                       const DepthCamera& depth_camera) {
  Image registered(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
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
  return registered;
}

/// Calls `use` with offset [px], distance [px] and depth of the measured pixels around `px`.
template <class Use>
void for_neighbours(const Image& registered, const Eigen::Vector2f& px, double radius_px,
                    Use&& use) {
  const int reach = static_cast<int>(std::ceil(radius_px));
  const int u0 = cvRound(px.x()), v0 = cvRound(px.y());
  for (int v = std::max(0, v0 - reach); v <= std::min(registered.rows - 1, v0 + reach); ++v)
    for (int u = std::max(0, u0 - reach); u <= std::min(registered.cols - 1, u0 + reach); ++u) {
      const float z = registered.at<float>(v, u);
      const double distance = std::hypot(u - px.x(), v - px.y());
      if (z != 0 && distance <= radius_px)
        use(Eigen::Vector2d(u - px.x(), v - px.y()), distance, z);
    }
}

std::optional<double> depth_at(const Image& registered, const Eigen::Vector2f& px, double margin_px,
                               const DepthLookupOptions& options) {
  double sum = 0, weight = 0;
  float nearest = std::numeric_limits<float>::max(), farthest = 0;
  for_neighbours(registered, px, margin_px, [&](const Eigen::Vector2d&, double distance, float z) {
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
    if (distance > options.radius_px) return;
    const double w = 1 / (0.5 + distance);
    sum += w * z;
    weight += w;
  });
  if (weight > 0 && farthest - nearest < options.max_spread * nearest) return sum / weight;
  return std::nullopt;
}

/// Gradient [1/m per px] of the inverse depth around a pixel; zero if its neighbours do not
/// determine it.
Eigen::Vector2d inverse_depth_gradient(const Image& registered, const Eigen::Vector2f& px,
                                       double margin_px) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for_neighbours(registered, px, margin_px, [&](const Eigen::Vector2d& offset, double, float z) {
    const Eigen::Vector3d a = offset.homogeneous();
    H += a * a.transpose();
    b += a / z;
  });
  const Eigen::LDLT<Eigen::Matrix3d> solved(H);
  constexpr double kFewest = 10, kSpread = 1;  // [px^2], of the narrower direction
  const Eigen::Vector3d pivots = solved.vectorD();
  if (!(H(2, 2) >= kFewest && pivots.minCoeff() > kSpread)) return Eigen::Vector2d::Zero();
  return solved.solve(b).head<2>();
}

double margin_of(const Camera& camera, const DepthLookupOptions& options) {
  return std::max(std::min(options.radius_px, options.margin_px),
                  options.margin_px * (camera.fx / options.margin_focal_px));
}

}  // namespace

std::vector<std::optional<double>> lookup_depth(const Image& depth_m, const Camera& camera,
                                                const DepthCamera& depth_camera,
                                                const std::vector<Eigen::Vector2f>& px,
                                                const DepthLookupOptions& options) {
  require(depth_m.type() == CV_32FC1, "lookup_depth: depth image in metres (CV_32FC1) needed");
  const Image registered = registered_depth(depth_m, camera, depth_camera);
  const double margin_px = margin_of(camera, options);
  std::vector<std::optional<double>> depths;
  for (const Eigen::Vector2f& p : px) depths.push_back(depth_at(registered, p, margin_px, options));
  return depths;
}

std::vector<std::optional<SurfaceDepth>> lookup_surfaces(const Image& depth_m, const Camera& camera,
                                                         const DepthCamera& depth_camera,
                                                         const std::vector<Eigen::Vector2f>& px,
                                                         const DepthLookupOptions& options) {
  require(depth_m.type() == CV_32FC1, "lookup_surfaces: depth image in metres (CV_32FC1) needed");
  const Image registered = registered_depth(depth_m, camera, depth_camera);
  const double margin_px = margin_of(camera, options);
  std::vector<std::optional<SurfaceDepth>> surfaces;
  for (const Eigen::Vector2f& p : px) {
    surfaces.emplace_back();
    if (const auto depth = depth_at(registered, p, margin_px, options))
      surfaces.back() = {*depth, inverse_depth_gradient(registered, p, margin_px)};
  }
  return surfaces;
}

Eigen::Vector3d plane_through(const Camera& camera, const Eigen::Vector3d& ray,
                              const SurfaceDepth& surface) {
  if (surface.gradient.isZero(0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector2d slope =
      surface.gradient.cwiseProduct(Eigen::Vector2d(camera.fx, camera.fy));
  return {slope.x(), slope.y(), 1 / surface.depth_m - slope.dot(ray.head<2>())};
}

}  // namespace placegraph
