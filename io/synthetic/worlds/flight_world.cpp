#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/aruco.hpp>

namespace placegraph::synthetic {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPatch_m = 3;      ///< side of the floor's square patches
constexpr int kPatches = 6;         ///< patches per row
constexpr double kSheet_m = 0.002;  ///< height of paper and housings above the floor
constexpr double kHousing_m = 0.06;

/// Pose of the world (z up) in the scene's axes (y down).
SE3 T_scene_world() {
  Matrix3d R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return {R, Vector3d(0, 0, 0)};
}

Glyph april_tag(int id) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  Glyph glyph;
  glyph.cells = dictionary->markerSize + 2;
  cv::Mat drawn;
  cv::aruco::drawMarker(dictionary, id, glyph.cells, drawn, 1);
  for (int row = 0; row < glyph.cells; ++row)
    for (int column = 0; column < glyph.cells; ++column)
      glyph.white.push_back(drawn.at<unsigned char>(row, column) > 127);
  return glyph;
}

/// A level square around `centre`, its s along `right` and its t along `down` (world).
Face square(const SE3& T_world_square, double side_m, Material material, std::uint32_t seed) {
  const double h = side_m / 2;
  const SE3 T = T_scene_world() * T_world_square;
  const Vector3d corner = T * Vector3d(-h, h, 0);
  const Vector3d right = T.rotation() * Vector3d(side_m, 0, 0);
  const Vector3d down = T.rotation() * Vector3d(0, -side_m, 0);
  Face face = make_quad(corner, right, down, material, SurfaceClass::kFurniture, seed);
  // make_quad's normal is right x down, into the floor.
  face.normal = -face.normal;
  face.t_axis = down.normalized();
  return face;
}

void lay_floor(Scene& scene, Random& random) {
  Part part;
  const int plane = scene.add_plane({0, -1, 0}, {0, 0, 0});
  const double begin = -0.5 * kPatch_m * kPatches;
  for (int i = 0; i < kPatches; ++i)
    for (int j = 0; j < kPatches; ++j) {
      const int kind = random.index(5);
      const SE3 T_world_patch(
          SO3(), Vector3d(begin + kPatch_m * (i + 0.5), begin + kPatch_m * (j + 0.5), 0));
      const Material material = kind < 3    ? Material::kIndoorFloor
                                : kind == 3 ? Material::kConcrete
                                            : Material::kTerrain;
      Face face = square(T_world_patch, kPatch_m, material, random.next());
      face.style = kind == 0 ? 0.2F : kind == 1 ? 0.5F : 0.9F;  // tiles, boards, worn concrete
      face.label = SurfaceClass::kFloor;
      face.plane = plane;
      face.light = material == Material::kTerrain ? 1.5F : 1;
      part.faces.push_back(face);
    }
  part.finish();
  scene.parts.push_back(part);
}

/// Six markers on a jittered grid of 3 x 2, four beacons between and beside them.
MarkerLayout make_layout(Random& random) {
  constexpr int kTags = 587, kMarkers = 6;
  MarkerLayout layout;
  std::vector<int> ids;
  random.sample(kTags, kMarkers, ids);
  for (int i = 0; i < kMarkers; ++i) {
    const double x = 0.6 * (i % 3 - 1) + random.uniform(-0.1, 0.1);
    const double y = 0.7 * (i / 3 - 0.5) + random.uniform(-0.1, 0.1);
    const double yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
    PlacedMarker marker;
    marker.id = ids[static_cast<std::size_t>(i)];
    marker.side_m = 0.01 * std::round(random.uniform(14, 22));
    marker.T_world_marker = SE3(SO3::exp({0, 0, yaw}), Vector3d(x, y, kSheet_m));
    layout.markers.push_back(marker);
  }
  for (int i = 0; i < 4; ++i) {
    const double x = 0.9 * (i % 2 - 0.5) + random.uniform(-0.05, 0.05);
    const double y = 1.5 * (i / 2 - 0.5) + random.uniform(-0.05, 0.05);
    layout.beacons_world.emplace_back(x, y, kSheet_m);
  }
  return layout;
}

void place(const MarkerLayout& layout, Scene& scene) {
  Part part;
  for (const PlacedMarker& marker : layout.markers) {
    const auto index = static_cast<std::uint32_t>(scene.glyphs.size());
    scene.glyphs.push_back(april_tag(marker.id));
    const double cells = scene.glyphs.back().cells;
    part.faces.push_back(square(marker.T_world_marker, marker.side_m * (cells + 2) / cells,
                                Material::kGlyph, index));
  }
  for (const Vector3d& beacon : layout.beacons_world)
    part.faces.push_back(square({SO3(), beacon}, kHousing_m, Material::kBeacon, 0));
  part.finish();
  scene.parts.push_back(part);
}

/// Mounting of a downward camera with the image's top towards the body's x, slightly tilted.
SE3 camera_mounting() {
  Matrix3d R;
  R << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  return SE3(R, Vector3d(0.06, -0.01, -0.05)) *
         SE3(SO3::exp({0.02, -0.03, 0.01}), Vector3d(0, 0, 0));
}

}  // namespace

SE3 FlightSetting::T_world_scene() { return synthetic::T_scene_world().inverse(); }

Tour make_flight_world(const TourRequest& request) {
  Random random(request.seed, 51);
  Tour tour;
  tour.name = "flight";
  tour.scene.outdoor = false;
  tour.scene.seed = mix_bits(static_cast<std::uint32_t>(request.seed) * 2654435761U + 277U);
  lay_floor(tour.scene, random);
  FlightSetting setting;
  setting.layout = make_layout(random);
  place(setting.layout, tour.scene);
  setting.T_body_cam = camera_mounting();
  SimulatedFlightOptions options;
  options.seed = request.seed;
  if (request.duration_s > 0) options.duration_s = request.duration_s;
  setting.flight = simulate_flight(options);

  tour.camera = {.width = 640, .height = 480, .fx = 400, .fy = 400, .cx = 319.5, .cy = 239.5};
  const Matrix3d R_cam_body = setting.T_body_cam.rotation().inverse().matrix();
  const SimulatedFlight& flight = setting.flight;
  for (const std::size_t at : flight.images) {
    const BodyState& state = flight.truth[at];
    tour.time_s.push_back(1e-9 * static_cast<double>(state.stamp_ns));
    tour.T_scene_cam.push_back(T_scene_world() * state.T_world_body * setting.T_body_cam);
    const Vector3d& rate = flight.angular_velocity[at];
    const Vector3d v_body = state.T_world_body.rotation().inverse() * state.velocity_world;
    Vector6d velocity;
    velocity << R_cam_body * (v_body + rate.cross(setting.T_body_cam.translation())),
        R_cam_body * rate;
    tour.velocity_cam.push_back(velocity);
  }
  tour.flight_setting = std::make_shared<const FlightSetting>(std::move(setting));
  return tour;
}

}  // namespace placegraph::synthetic
