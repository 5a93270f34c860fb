#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/worlds/tours.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>
#include <placegraph/io/synthetic/worlds/traffic.h>

#include <algorithm>
#include <memory>

namespace placegraph::synthetic {
namespace {

constexpr double kPathStep_m = 0.5;
constexpr double kOncomingLane_m = 3.4;  ///< left of the camera's own track
constexpr double kOncomingSpeed_mps = 8;
constexpr double kMinGap_m = 2.6;  ///< between a mover's centre and the camera

/// The camera's path as a curve: arc length at each time, and points at even steps.
struct CameraPath {
  std::vector<Eigen::Vector2d> path;  // steps of kPathStep_m
  std::vector<double> time_s, s;
  std::vector<Eigen::Vector2d> position;

  double at(double t) const {
    if (t <= time_s.front()) return s.front();
    if (t >= time_s.back()) return s.back();
    const auto it = std::upper_bound(time_s.begin(), time_s.end(), t);
    const auto i = static_cast<std::size_t>(it - time_s.begin()) - 1;
    const double f = (t - time_s[i]) / (time_s[i + 1] - time_s[i]);
    return s[i] + f * (s[i + 1] - s[i]);
  }
};

CameraPath make_camera_path(const std::vector<double>& time_s,
                            const std::vector<SE3>& T_scene_cam) {
  CameraPath camera_path;
  camera_path.time_s = time_s;
  double s = 0;
  std::vector<Eigen::Vector2d> moved;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const Eigen::Vector3d p = T_scene_cam[i].translation();
    camera_path.position.emplace_back(p[0], p[2]);
    if (i) s += (camera_path.position[i] - camera_path.position[i - 1]).norm();
    camera_path.s.push_back(s);
    if (moved.empty() || (camera_path.position[i] - moved.back()).norm() > 0.2)
      moved.push_back(camera_path.position[i]);
  }
  if (moved.size() > 1) camera_path.path = smooth_path(moved, kPathStep_m, 3);
  return camera_path;
}

bool keeps_clear(const CameraPath& camera_path, const MovingObject& mover) {
  for (std::size_t i = 0; i < camera_path.time_s.size(); ++i) {
    const auto T = mover.T_scene_object(camera_path.time_s[i]);
    if (!T) continue;
    const Eigen::Vector3d p = T->translation(), z = T->rotation().matrix().col(2);
    const Footprint body{{p[0], p[2]}, Eigen::Vector2d(z[0], z[2]).normalized(), 2.2, 0.9};
    if (body.distance(camera_path.position[i]) < kMinGap_m - 1.0) return false;
  }
  return true;
}

}  // namespace

SE3 car_pose(const GroundMesh& ground, const Eigen::Vector2d& position,
             const Eigen::Vector2d& direction) {
  const Eigen::Vector2d nose = position + 1.4 * direction, tail = position - 1.4 * direction;
  const double front = ground.height(nose[0], nose[1]), back = ground.height(tail[0], tail[1]);
  const Eigen::Vector3d z =
      Eigen::Vector3d(direction[0], (front - back) / 2.8, direction[1]).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d(direction[1], 0, -direction[0]).normalized();
  Eigen::Matrix3d R;
  R << x, z.cross(x), z;
  return SE3(R, Eigen::Vector3d(position[0], 0.5 * (front + back), position[1]));
}

bool add_crossing_car(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                      const std::vector<SE3>& T_scene_cam, const Eigen::Vector2d& crossing,
                      const Eigen::Vector2d& direction, double crossing_time_s, double speed_mps,
                      std::uint32_t seed) {
  MovingObject mover;
  mover.part = make_car(seed);
  const auto shared = std::make_shared<GroundMesh>(ground);
  mover.T_scene_object = [=](double t) -> std::optional<SE3> {
    const double s = speed_mps * (t - crossing_time_s);
    if (s < -65 || s > 65) return std::nullopt;
    return car_pose(*shared, crossing + s * direction, direction);
  };
  if (!keeps_clear(make_camera_path(time_s, T_scene_cam), mover)) return false;
  scene.movers.push_back(std::move(mover));
  return true;
}

void add_traffic(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                 const std::vector<SE3>& T_scene_cam, double per_minute, std::uint64_t seed) {
  if (per_minute <= 0 || time_s.size() < 2) return;
  const auto camera_path = std::make_shared<CameraPath>(make_camera_path(time_s, T_scene_cam));
  if (camera_path->path.size() < 100) return;
  const auto shared_ground = std::make_shared<GroundMesh>(ground);
  const double total_m = kPathStep_m * static_cast<double>(camera_path->path.size() - 1);
  Random random(seed, 21);
  const double interval_s = 60 / per_minute;
  for (double t = time_s.front() + random.uniform(3, 3 + interval_s); t < time_s.back();
       t += random.uniform(0.5, 1.5) * interval_s) {
    MovingObject mover;
    mover.part = make_car(random.next());
    if (random.uniform() < 0.7) {
      // Oncoming: on the left lane of the camera's path, met at time t.
      const double met_m = camera_path->at(t);
      mover.T_scene_object = [=](double now) -> std::optional<SE3> {
        if (now < t - 7 || now > t + 1.2) return std::nullopt;
        const double s = met_m - kOncomingSpeed_mps * (now - t);
        if (s < 0 || s > total_m) return std::nullopt;
        const PathPoint p = path_point(camera_path->path, kPathStep_m, s);
        const Eigen::Vector2d left(-p.direction[1], p.direction[0]);
        return car_pose(*shared_ground, p.position + kOncomingLane_m * left, -p.direction);
      };
    } else {
      // Ahead: the camera catches up, then falls back; 5 m/s of difference, 14 m at the closest.
      mover.T_scene_object = [=](double now) -> std::optional<SE3> {
        const double d = 5 * (now - t);
        if (std::abs(d) > 80) return std::nullopt;
        const double s = camera_path->at(now) + 10 + std::sqrt(d * d + 16);
        if (s > total_m) return std::nullopt;
        const PathPoint p = path_point(camera_path->path, kPathStep_m, s);
        return car_pose(*shared_ground, p.position, p.direction);
      };
    }
    if (keeps_clear(*camera_path, mover)) scene.movers.push_back(std::move(mover));
  }
}

}  // namespace placegraph::synthetic
