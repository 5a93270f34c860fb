#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <algorithm>
#include <cmath>

namespace placegraph::synthetic {

Camera kitti_camera() {
  Camera camera;
  camera.width = 1241;
  camera.height = 376;
  camera.fx = camera.fy = 707.0912;
  camera.cx = 601.8873;
  camera.cy = 183.1104;
  return camera;
}

namespace {

std::vector<Eigen::Vector2d> resample(const std::vector<Eigen::Vector2d>& line, double step_m) {
  std::vector<Eigen::Vector2d> out;
  double next = 0, passed = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d d = line[i + 1] - line[i];
    const double length = d.norm();
    for (; next <= passed + length; next += step_m)
      out.push_back(line[i] + d * ((next - passed) / length));
    passed += length;
  }
  return out;
}

std::vector<Eigen::Vector2d> box_filter(const std::vector<Eigen::Vector2d>& p, int half) {
  std::vector<Eigen::Vector2d> out(p.size());
  const int n = static_cast<int>(p.size());
  for (int i = 0; i < n; ++i) {
    const int h = std::min({half, i, n - 1 - i});  // narrower towards the ends, which stay
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int j = i - h; j <= i + h; ++j) sum += p[j];
    out[i] = sum / (2 * h + 1);
  }
  return out;
}

}  // namespace

std::vector<Eigen::Vector2d> smooth_path(const std::vector<Eigen::Vector2d>& corners, double step_m,
                                         double window_m) {
  std::vector<Eigen::Vector2d> path = resample(corners, step_m);
  const int half = static_cast<int>(0.5 * window_m / step_m);
  for (int i = 0; i < 3; ++i) path = box_filter(path, half);
  return resample(path, step_m);
}

std::vector<double> drive_positions(const std::vector<Eigen::Vector2d>& path, double step_m,
                                    const SpeedLimits& limits, double interval_s) {
  const int n = static_cast<int>(path.size());
  std::vector<double> v(n, limits.cruise_mps);
  const int reach = std::max(1, static_cast<int>(1.0 / step_m));
  for (int i = reach; i + reach < n; ++i) {
    const Eigen::Vector2d a = path[i] - path[i - reach], b = path[i + reach] - path[i];
    const double sin_angle = std::abs(a[0] * b[1] - a[1] * b[0]) / (a.norm() * b.norm());
    const double curvature = sin_angle / (reach * step_m) + 1e-9;
    v[i] = std::min(v[i], std::sqrt(limits.lateral_mps2 / curvature));
  }
  const double gain = 2 * limits.forward_mps2 * step_m;
  for (int i = 1; i < n; ++i) v[i] = std::min(v[i], std::sqrt(v[i - 1] * v[i - 1] + gain));
  for (int i = n - 2; i >= 0; --i) v[i] = std::min(v[i], std::sqrt(v[i + 1] * v[i + 1] + gain));
  // The corners of this profile would be jerks, but a car's speed changes smoothly.
  std::vector<double> smooth(n);
  const int half = static_cast<int>(3.0 / step_m);
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    int count = 0;
    for (int j = std::max(0, i - half); j <= std::min(n - 1, i + half); j += 2) {
      sum += v[j];
      ++count;
    }
    smooth[i] = sum / count;
  }
  std::vector<double> positions;
  double s = 0, ahead = 0;  // time left until the next frame
  for (int i = 0; i + 1 < n; ++i) {
    const double dt = step_m / smooth[i];
    while (ahead <= dt) {
      positions.push_back(s + smooth[i] * ahead);
      ahead += interval_s;
    }
    ahead -= dt;
    s += step_m;
  }
  return positions;
}

PathPoint path_point(const std::vector<Eigen::Vector2d>& path, double step_m, double s) {
  const int n = static_cast<int>(path.size());
  const double at = std::clamp(s / step_m, 0.0, n - 1.000001);
  const int i = static_cast<int>(at);
  const double f = at - i;
  // Direction over two metres, linear between samples: smooth as the path itself.
  const int reach = std::max(1, static_cast<int>(1.0 / step_m));
  const auto slope = [&](int k) {
    return Eigen::Vector2d(path[std::min(n - 1, k + reach)] - path[std::max(0, k - reach)]);
  };
  const Eigen::Vector2d direction = (1 - f) * slope(i) + f * slope(std::min(n - 1, i + 1));
  return {(1 - f) * path[i] + f * path[i + 1], direction.normalized()};
}

Eigen::Matrix3d camera_axes(const Eigen::Vector3d& forward, const Eigen::Vector3d& up, double pitch,
                            double yaw, double roll) {
  Eigen::Vector3d z = (forward - up * up.dot(forward)).normalized();
  const Eigen::Vector3d x0 = (-up).cross(z);
  z = (z + yaw * x0 + pitch * up).normalized();
  Eigen::Vector3d x = x0 + roll * up;
  x = (x - z * z.dot(x)).normalized();
  Eigen::Matrix3d R;
  R << x, z.cross(x), z;
  return R;
}

}  // namespace placegraph::synthetic
