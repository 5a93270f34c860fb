#include <placegraph/frontend/floor_plan/plan_surfaces.h>
#include <placegraph/graph/core/error.h>
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace placegraph {
namespace {

/// Maximum relative rms distance of a patch's inverse depths from its plane, beyond their noise; a
/// point with a larger one has no normal. Chosen: 1 % of the depth.
constexpr double kMaxPatchResidual = 0.01;

/// Plane of a patch in inverse depth over normalized coordinates: (a, b, c) . (x, y, 1) = 1/z.
struct PatchPlane {
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double residual = 0;  ///< rms relative to 1/z
  bool good = false;
};

PatchPlane fit_patch(const Image& depth_m, const Camera& camera, int u, int v, int radius) {
  PatchPlane fit;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double squares = 0;
  int count = 0, all = 0;
  const int step = std::max(1, radius / 3);
  for (int y = v - radius; y <= v + radius; y += step)
    for (int x = u - radius; x <= u + radius; x += step) {
      if (x < 0 || y < 0 || x >= depth_m.cols || y >= depth_m.rows) continue;
      ++all;
      const float z = depth_m.at<float>(y, x);
      if (z <= 0) continue;
      // About the patch's middle, for a good condition number.
      const Eigen::Vector3d p((x - u) / camera.fx, (y - v) / camera.fy, 1);
      const double w = 1.0 / z;
      A += p * p.transpose();
      b += p * w;
      squares += w * w;
      ++count;
    }
  if (count < 8 || 4 * count < 3 * all) return fit;
  const Eigen::Vector3d s = A.ldlt().solve(b);
  if (!(s[2] > 0)) return fit;
  fit.residual = std::sqrt(std::max(0.0, (squares - s.dot(b)) / count)) / s[2];
  fit.plane = {s[0], s[1],
               s[2] - s[0] * (u - camera.cx) / camera.fx - s[1] * (v - camera.cy) / camera.fy};
  fit.good = true;
  return fit;
}

}  // namespace

std::vector<SurfacePoint> surface_points(const Image& depth_m, const Image& sigma_inverse,
                                         const Camera& depth_camera, const SE3& T_cam_depth,
                                         const SurfacePointOptions& options) {
  options.check();
  const auto fits = [&](const Image& image) {
    return image.type() == CV_32FC1 && image.cols == depth_camera.width &&
           image.rows == depth_camera.height;
  };
  require(fits(depth_m) && fits(sigma_inverse),
          "surface points: needs a CV_32FC1 depth image of the camera's size");
  std::vector<SurfacePoint> points;
  const Eigen::Matrix3d R = T_cam_depth.rotation().matrix();
  for (int v = options.step_px / 2; v < depth_m.rows; v += options.step_px)
    for (int u = options.step_px / 2; u < depth_m.cols; u += options.step_px) {
      const double z = depth_m.at<float>(v, u);
      if (z <= 0 || z > options.max_range_m) continue;
      const Eigen::Vector3d ray((u - depth_camera.cx) / depth_camera.fx,
                                (v - depth_camera.cy) / depth_camera.fy, 1);
      SurfacePoint point;
      point.point = (T_cam_depth * Eigen::Vector3d(z * ray)).cast<float>();
      const PatchPlane fit = fit_patch(depth_m, depth_camera, u, v, options.radius_px);
      const double sigma_at_1m = sigma_inverse.at<float>(v, u);
      double sigma = sigma_at_1m * z * z;
      if (fit.good && fit.residual < kMaxPatchResidual + 2 * sigma_at_1m * z) {
        const Eigen::Vector3d normal = -fit.plane.normalized();
        // The patch's own depth is more accurate than that of one pixel.
        const double z_plane = 1 / fit.plane.dot(ray);
        if (std::abs(z_plane - z) < 0.05 * z)
          point.point = (T_cam_depth * Eigen::Vector3d(z_plane * ray)).cast<float>();
        sigma = std::hypot(sigma, fit.residual * z);
        sigma *= std::abs(normal.dot(ray));
        point.normal = (R * normal).cast<float>();
      }
      point.sigma = static_cast<float>(sigma);
      points.push_back(point);
    }
  return points;
}

std::vector<SurfacePoint> surface_points(const Image& depth_m, const Camera& depth_camera,
                                         const SE3& T_cam_depth, double sigma_at_1m,
                                         const SurfacePointOptions& options) {
  return surface_points(depth_m, Image(depth_m.size(), CV_32FC1, cv::Scalar(sigma_at_1m)),
                        depth_camera, T_cam_depth, options);
}

Image dense_stereo(const Image& left, const Image& right, double fx, double baseline_m,
                   const DenseStereoOptions& options) {
  options.check();
  require(options.disparities % 16 == 0, "disparities: must be a multiple of 16");
  require(left.size() == right.size() && left.type() == CV_8UC1 && right.type() == CV_8UC1,
          "dense stereo: needs two grey images of one size");
  const int w = options.window_px;
  const auto matcher = cv::StereoSGBM::create(0, options.disparities, w, 8 * w * w, 32 * w * w, 1,
                                              31, 10, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  Image disparity;
  matcher->compute(left, right, disparity);
  Image depth(left.size(), CV_32FC1, cv::Scalar(0));
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const double d = disparity.at<std::int16_t>(v, u) / 16.0;
      if (d >= 1) depth.at<float>(v, u) = static_cast<float>(fx * baseline_m / d);
    }
  return depth;
}

}  // namespace placegraph
