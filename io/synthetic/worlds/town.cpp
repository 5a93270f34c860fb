#include <placegraph/io/synthetic/defects/vehicle.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/tours.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>
#include <placegraph/io/synthetic/worlds/traffic.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

constexpr double kStreets_x[] = {0, 70};
constexpr double kStreets_z[] = {0, 60, 120};
constexpr double kBeyond_m = 75;  ///< length of the streets beyond the last crossing
constexpr double kLane_m = 1.75;  ///< right of the street's middle
constexpr double kStep_m = 0.25;

/// Round the large block, then along the first street again, round the southern block: two long
/// stretches are driven twice in the same direction, the last one begins a third round.
std::vector<Eigen::Vector2d> route() {
  const double l = kLane_m, e = 70 - l, n = 120 - l, m = 60 - l;
  return {{l, 10}, {l, n}, {e, n}, {e, l}, {l, l}, {l, m}, {e, m}, {e, l}, {l, l}, {l, 50}};
}

Roadway street(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Roadway roadway;
  const int n = static_cast<int>((to - from).norm() / 2);
  for (int i = 0; i <= n; ++i) roadway.centre.push_back(from + (to - from) * (1.0 * i / n));
  return roadway;
}

HeightSurface hills(std::uint32_t seed) {
  return HeightSurface::from_function({-450, -450}, {550, 600}, 5, [seed](double x, double z) {
    return -1.1 * value_noise(x / 85, z / 85, seed) - 0.15 * value_noise(x / 23, z / 23, seed + 1);
  });
}

void add_crossing_traffic(Tour& tour, const GroundMesh& ground, std::uint32_t seed) {
  // At crossings where the route goes straight on, a car comes from the right before or after.
  for (const double x : kStreets_x) {
    for (const double z : kStreets_z) {
      int times = 0;
      for (std::size_t i = 30; i + 1 < tour.time_s.size(); ++i) {
        const Eigen::Vector3d p = tour.T_scene_cam[i].translation();
        const double distance = std::hypot(p[0] - x, p[2] - z);
        const Eigen::Vector3d q = tour.T_scene_cam[i - 1].translation();
        if (distance > 26 || std::hypot(q[0] - x, q[2] - z) <= 26) continue;
        const Eigen::Vector2d ahead(p[0] - q[0], p[2] - q[2]);
        const bool north_south = std::abs(ahead[1]) > std::abs(ahead[0]);
        const double along =
            hash_cell(static_cast<int>(x), static_cast<int>(z), seed + times) & 1U ? 1 : -1;
        const Eigen::Vector2d direction =
            north_south ? Eigen::Vector2d(along, 0) : Eigen::Vector2d(0, along);
        const Eigen::Vector2d lane = kLane_m * Eigen::Vector2d(direction[1], -direction[0]);
        add_crossing_car(tour.scene, ground, tour.time_s, tour.T_scene_cam,
                         Eigen::Vector2d(x, z) + lane, direction, tour.time_s[i] + 0.6, 9,
                         seed + 31U * static_cast<std::uint32_t>(i));
        ++times;
      }
    }
  }
}

}  // namespace

Tour make_town_loop(const TourRequest& request) {
  const std::vector<Eigen::Vector2d> path = smooth_path(route(), kStep_m, 11);
  const auto seed = mix_bits(static_cast<std::uint32_t>(request.seed) + 1000U);
  TownPlan plan{{},
                GroundMesh(hills(seed), Undulation(request.undulation_m, request.seed)),
                path,
                request.seed};
  for (const double x : kStreets_x)
    plan.roads.push_back(street({x, kStreets_z[0] - kBeyond_m}, {x, kStreets_z[2] + kBeyond_m}));
  for (const double z : kStreets_z)
    plan.roads.push_back(street({kStreets_x[0] - kBeyond_m, z}, {kStreets_x[1] + kBeyond_m, z}));
  plan.roads.push_back({path, 2.2, false, false});  // rounds the kerbs where the car turns

  Tour tour;
  tour.name = "town-loop";
  tour.scene = build_town(plan);
  tour.camera = kitti_camera();
  tour.baseline_m = kKittiBaseline_m;
  tour.camera_height_m = kDriveHeight_m;
  const std::vector<double> positions = drive_positions(path, kStep_m, {}, 0.1);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i);
    const PathPoint p = path_point(path, kStep_m, positions[i]);
    // The body nods when it brakes, leans in bends, and the road shakes it.
    const std::size_t reach = std::min({std::size_t{3}, i, positions.size() - 1 - i});
    const double span = 0.1 * static_cast<double>(reach);
    const double acceleration =
        reach > 0 ? (positions[i + reach] - 2 * positions[i] + positions[i - reach]) / (span * span)
                  : 0;
    const double pitch = 0.003 * acceleration + 0.0022 * value_noise(t * 2.1, 0.5, seed + 2) +
                         0.0012 * value_noise(t * 5.3, 0.5, seed + 3);
    const double roll =
        0.004 * value_noise(t * 1.3, 0.5, seed + 4) + 0.0015 * value_noise(t * 4.1, 0.5, seed + 5);
    const double yaw = 0.0008 * value_noise(t * 3.1, 0.5, seed + 6);
    const double x = p.position[0], z = p.position[1];
    const Eigen::Matrix3d R = camera_axes({p.direction[0], 0, p.direction[1]},
                                          plan.ground.surface.normal(x, z), pitch, yaw, roll);
    tour.time_s.push_back(t);
    const double level = plan.ground.height(x, z) - plan.ground.undulation_at(x, z);
    tour.T_scene_cam.push_back(
        on_undulation(plan.ground, SE3(R, Eigen::Vector3d(x, level - kDriveHeight_m, z))));
  }
  add_traffic(tour.scene, plan.ground, tour.time_s, tour.T_scene_cam, request.sensor.traffic,
              request.seed);
  if (request.sensor.traffic > 0) add_crossing_traffic(tour, plan.ground, seed + 7);
  return tour;
}

}  // namespace placegraph::synthetic
