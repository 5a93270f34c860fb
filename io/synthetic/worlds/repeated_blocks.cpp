#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/tours.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>
#include <placegraph/io/synthetic/worlds/traffic.h>

#include <algorithm>
#include <limits>

namespace placegraph::synthetic {
namespace {

constexpr double kBlock_m = 64;  ///< whole cells of the fine and of the coarse ground
constexpr int kBlocks = 7;       ///< number of driven blocks
constexpr int kBeyond = 4;       ///< further blocks at either end, to hide the end of the street
constexpr double kStreetLane_m = 1.75;
constexpr double kStreetStep_m = 0.25;

bool is_ground(const Part& part) {
  const Material material = part.faces.front().material;
  return material == Material::kRoad || material == Material::kRoadside ||
         material == Material::kKerb || material == Material::kTerrain;
}

/// Extent of a part along the street.
std::pair<double, double> extent(const Part& part) {
  std::pair<double, double> z(std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::lowest());
  for (const Face& face : part.faces)
    for (int i = 0; i < face.count; ++i) {
      z.first = std::min(z.first, face.corners[static_cast<std::size_t>(i)][2]);
      z.second = std::max(z.second, face.corners[static_cast<std::size_t>(i)][2]);
    }
  return z;
}

/// Repeats the texture of the ground, which extends along the whole street, in every block.
void repeat_texture(Part& part) {
  for (Face& face : part.faces) {
    double middle = 0;
    for (int i = 0; i < face.count; ++i)
      middle += face.corners[static_cast<std::size_t>(i)][2] / face.count;
    face.origin[2] = kBlock_m * floor_int(middle / kBlock_m);
  }
}

Part copy_of(const Part& part, double shift_m, Scene& scene) {
  Part copy = transformed(part, SE3(SO3(), {0, 0, shift_m}));
  for (Face& face : copy.faces)
    if (face.plane > 0) face.plane = scene.add_plane(face.normal, face.origin);
  return copy;
}

/// Keeps the parts that are wholly within the first block and copies them to every other block.
void repeat_blocks(Scene& scene) {
  std::vector<Part> parts = std::move(scene.parts);
  scene.parts.clear();
  scene.planes.resize(1);
  for (Part& part : parts) {
    if (is_ground(part)) {
      repeat_texture(part);
      scene.parts.push_back(std::move(part));
      continue;
    }
    const auto [low, high] = extent(part);
    if (low < 0 || high > kBlock_m) continue;
    for (int block = -kBeyond; block < kBlocks + kBeyond; ++block)
      scene.parts.push_back(copy_of(part, block * kBlock_m, scene));
  }
}

}  // namespace

Tour make_repeated_blocks(const TourRequest& request) {
  const double begin = -kBeyond * kBlock_m, end = (kBlocks + kBeyond) * kBlock_m;
  const std::vector<Eigen::Vector2d> path =
      smooth_path({{kStreetLane_m, 1}, {kStreetLane_m, kBlocks * kBlock_m - 1}}, kStreetStep_m, 11);
  const GroundMesh flat(HeightSurface::from_function({-450, begin - 350}, {450, end + 350}, 50,
                                                     [](double, double) { return 0.0; }));
  Roadway street;
  for (double z = begin; z <= end; z += 2) street.centre.emplace_back(0, z);
  // Solids stay clear of the lane in every block, not only where it is driven.
  TownPlan plan{{street}, flat, path, request.seed};

  Tour tour;
  tour.name = "repeated-blocks";
  tour.scene = build_town(plan);
  repeat_blocks(tour.scene);
  tour.camera = kitti_camera();
  tour.baseline_m = kKittiBaseline_m;
  tour.camera_height_m = kDriveHeight_m;
  const auto seed = mix_bits(static_cast<std::uint32_t>(request.seed) + 5000U);
  const std::vector<double> positions = drive_positions(path, kStreetStep_m, {}, 0.1);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i);
    const PathPoint p = path_point(path, kStreetStep_m, positions[i]);
    const double pitch = 0.0022 * value_noise(t * 2.1, 0.5, seed);
    const double roll = 0.002 * value_noise(t * 1.3, 0.5, seed + 1);
    const double yaw = 0.0008 * value_noise(t * 3.1, 0.5, seed + 2);
    tour.time_s.push_back(t);
    tour.T_scene_cam.emplace_back(
        camera_axes({p.direction[0], 0, p.direction[1]}, {0, -1, 0}, pitch, yaw, roll),
        Eigen::Vector3d(p.position[0], -kDriveHeight_m, p.position[1]));
  }
  add_traffic(tour.scene, plan.ground, tour.time_s, tour.T_scene_cam, request.sensor.traffic,
              request.seed);
  return tour;
}

}  // namespace placegraph::synthetic
