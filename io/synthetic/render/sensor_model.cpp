#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/render/sensor_model.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

constexpr double kExposureWander_s = 4;  ///< time scale of the exposure's drift
constexpr double kVelocityStep_s = 0.01;

/// Bilinear, clamped at the border.
float sample(const Image& image, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(image.cols - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(image.rows - 1));
  const int ix = std::min(static_cast<int>(x), image.cols - 2),
            iy = std::min(static_cast<int>(y), image.rows - 2);
  const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
  const auto* a = image.ptr<float>(iy) + ix;
  const auto* b = image.ptr<float>(iy + 1) + ix;
  return mix(mix(a[0], a[1], fx), mix(b[0], b[1], fx), fy);
}

float blurred(const Image& image, int u, int v, float du, float dv) {
  constexpr int kMaxTaps = 24;
  const float length = std::max(std::abs(du), std::abs(dv));
  if (length < 0.4F) return image.ptr<float>(v)[u];
  const int taps = std::min(kMaxTaps, 2 + static_cast<int>(length));
  float sum = 0;
  for (int i = 0; i < taps; ++i) {
    const float f = (static_cast<float>(i) + 0.5F) / static_cast<float>(taps) - 0.5F;
    sum += sample(image, static_cast<float>(u) + f * du, static_cast<float>(v) + f * dv);
  }
  return sum / static_cast<float>(taps);
}

}  // namespace

std::vector<AffineMap> point_velocities(const Scene& scene, const View& view,
                                        const Eigen::Vector3d& velocity_cam,
                                        const Eigen::Vector3d& angular_velocity_cam) {
  AffineMap still;  // dp/dt = -w x p - v
  still.linear = -hat(angular_velocity_cam);
  still.offset = -velocity_cam;
  std::vector<AffineMap> maps{still};
  const SE3 T_cam_scene = view.T_scene_cam.inverse();
  for (const MovingObject& mover : scene.movers) {
    const auto before = mover.T_scene_object(view.time_s - kVelocityStep_s),
               now = mover.T_scene_object(view.time_s),
               after = mover.T_scene_object(view.time_s + kVelocityStep_s);
    AffineMap map = still;
    if (before && now && after) {
      const Eigen::Matrix4d rate = T_cam_scene.matrix() * (after->matrix() - before->matrix()) *
                                   (0.5 / kVelocityStep_s) *
                                   (now->inverse() * view.T_scene_cam).matrix();
      map.linear += rate.topLeftCorner<3, 3>();
      map.offset += rate.topRightCorner<3, 1>();
    }
    maps.push_back(map);
  }
  return maps;
}

Image expose(const Rendering& rendering, const View& view, const std::vector<AffineMap>& velocities,
             const SensorModel& model, std::uint32_t noise_seed, std::uint32_t exposure_seed) {
  const Camera& camera = view.camera;
  const float gain =
      255.0F * static_cast<float>(1 + model.exposure * value_noise(view.time_s / kExposureWander_s,
                                                                   0.5, exposure_seed));
  const auto sigma = static_cast<float>(model.noise_grey);
  const double inverse_fx = 1 / camera.fx;
  Image out(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < camera.height; ++v) {
    const auto* grey = rendering.grey.ptr<float>(v);
    const auto* iz = rendering.inverse_depth.ptr<float>(v);
    const auto* mover = rendering.mover.ptr<short>(v);
    auto* to = out.ptr<unsigned char>(v);
    const double y = (v - camera.cy) / camera.fy;
    for (int u = 0; u < camera.width; ++u) {
      float value = grey[u];
      if (model.shutter_s > 0) {
        const AffineMap& map = velocities[mover[u] + 1];
        const double x = (u - camera.cx) * inverse_fx;
        const Eigen::Vector3d d = map.linear * Eigen::Vector3d(x, y, 1) + map.offset * iz[u];
        value = blurred(rendering.grey, u, v,
                        static_cast<float>(camera.fx * model.shutter_s * (d[0] - x * d[2])),
                        static_cast<float>(camera.fy * model.shutter_s * (d[1] - y * d[2])));
      }
      value *= gain;
      if (sigma > 0) value += sigma * hash_normal(hash_cell(u, v, noise_seed));
      to[u] = static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
    }
  }
  return out;
}

}  // namespace placegraph::synthetic
