#include "apps/train/environment_samples.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/pipeline/environment.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "apps/support/labelled_set.h"

namespace placegraph::apps {
namespace {

/// Kind of a room by its name; nothing for shafts, which cannot be entered.
std::optional<Environment> kind_of_name(const std::string& name) {
  if (name.starts_with("shaft")) return std::nullopt;
  if (name.starts_with("corridor")) return Environment::kCorridor;
  if (name.starts_with("hall")) return Environment::kHall;
  return Environment::kRoom;
}

/// Kind of the room at a point of the plan; nothing outside and for rooms with other names.
std::optional<Environment> kind_of_room(const nlohmann::json& plan, const Eigen::Vector3d& p) {
  for (const nlohmann::json& room : plan.at("rooms")) {
    const auto low = room.at("low").get<std::vector<double>>();
    const auto high = room.at("high").get<std::vector<double>>();
    if (p.x() < low.at(0) || p.x() > high.at(0) || p.z() < low.at(1) || p.z() > high.at(1))
      continue;
    return kind_of_name(room.at("name").get<std::string>());
  }
  return std::nullopt;
}

/// A view from a random position in a room, as from a handheld camera; nothing if it is blocked.
std::optional<Frame> handheld_view(const SyntheticWorld& world, const nlohmann::json& room,
                                   double floor_y, Random& random) {
  constexpr double kMargin_m = 0.7, kNearest_m = 0.5;
  const auto low = room.at("low").get<std::vector<double>>();
  const auto high = room.at("high").get<std::vector<double>>();
  const auto inside = [&](std::size_t i) {
    return low.at(i) + 2 * kMargin_m < high.at(i)
               ? random.uniform(low.at(i) + kMargin_m, high.at(i) - kMargin_m)
               : 0.5 * (low.at(i) + high.at(i));
  };
  const double x = inside(0), z = inside(1), height = random.uniform(1.1, 1.7);
  const Eigen::Vector3d yaw(0, random.uniform(-std::numbers::pi, std::numbers::pi), 0);
  const Eigen::Vector3d pitch(random.uniform(-0.7, 0.2), 0, 0),
      roll(0, 0, random.uniform(-0.5, 0.5));
  Frame frame = world.view_from(SE3(SO3::exp(yaw) * SO3::exp(pitch) * SO3::exp(roll),
                                    Eigen::Vector3d(x, floor_y - height, z)));
  if (cv::countNonZero(frame.depth < kNearest_m) > 0.2 * static_cast<double>(frame.depth.total()))
    return std::nullopt;
  for (int v = 0; v < frame.image.rows; ++v)
    for (int u = 0; u < frame.image.cols; ++u)
      frame.image.at<std::uint8_t>(v, u) =
          cv::saturate_cast<std::uint8_t>(frame.image.at<std::uint8_t>(v, u) + random.normal(0, 2));
  return frame;
}

/// Adds `count` of such views, the kinds of rooms in turn.
void add_handheld(const SyntheticWorld& world, const nlohmann::json& plan, int count,
                  const SurfaceModel& surfaces, std::vector<EnvironmentSample>& samples) {
  std::vector<std::vector<const nlohmann::json*>> rooms(kEnvironmentCount);
  for (const nlohmann::json& room : plan.at("rooms"))
    if (const auto kind = kind_of_name(room.at("name").get<std::string>()))
      rooms[static_cast<std::size_t>(*kind)].push_back(&room);
  Random random(world.options().seed, 5);
  const double floor_y = plan.at("floor_y").get<double>();
  for (int i = 0; i < count; ++i) {
    const auto kind = static_cast<std::size_t>(i % kEnvironmentCount);
    if (rooms[kind].empty()) continue;
    const nlohmann::json& room =
        *rooms[kind][static_cast<std::size_t>(random.index(static_cast<int>(rooms[kind].size())))];
    if (const auto frame = handheld_view(world, room, floor_y, random))
      samples.push_back({evidence_of_view(*frame, world.calibration().camera, surfaces),
                         static_cast<Environment>(kind)});
  }
}

}  // namespace

std::vector<EnvironmentSample> samples_of_world(const std::string& name, std::uint64_t seed,
                                                int frames, const SurfaceModel& surfaces) {
  std::vector<EnvironmentSample> samples;
  SyntheticOptions options;
  options.world = name;
  options.seed = seed;
  const SyntheticWorld world(options);
  const Camera camera = world.calibration().camera;
  const Trajectory truth = world.ground_truth();
  nlohmann::json plan;
  if (world.is_indoor()) plan = nlohmann::json::parse(world.floor_plan());
  for (int i = 0; i < frames; ++i) {
    const std::size_t at =
        world.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(frames);
    std::optional<Environment> kind = Environment::kStreet;
    if (world.is_indoor()) kind = kind_of_room(plan, truth.poses[at].T_world_body->translation());
    if (!kind) continue;
    const SyntheticFrame seen = world.render(at, {.depth = true});
    samples.push_back({evidence_of_view(seen.frame, camera, surfaces), *kind});
  }
  if (world.is_indoor()) add_handheld(world, plan, 2 * frames, surfaces, samples);
  return samples;
}

std::vector<EnvironmentSample> samples_of_images(const std::string& data,
                                                 const SurfaceModel& surfaces) {
  std::vector<EnvironmentSample> samples;
  constexpr double kStreetShare = 0.12, kRoadShare = 0.03;
  const LabelledSet set = read_labelled_set(data);
  const auto building = std::find_if(set.classes.begin(), set.classes.end(),
                                     [](const SceneClass& c) { return c.name == "Building"; });
  require(building != set.classes.end(), data + ": has no class Building");
  constexpr std::size_t kStep = 3;  // consecutive images of a drive are similar
  for (std::size_t i = 0; i < set.train.size(); i += kStep) {
    Frame frame;
    const Image labels = read_image_as_stored(set.train[i].labels);
    const GreyAndColour image = read_image(set.train[i].image);
    frame.image = image.grey;
    frame.colour = image.colour;
    const double share = static_cast<double>(cv::countNonZero(labels == building->id)) /
                         static_cast<double>(labels.total());
    if (share > kRoadShare && share < kStreetShare) continue;
    Camera camera;  // a lens of about 58 degrees
    camera.width = frame.image.cols;
    camera.height = frame.image.rows;
    camera.fx = camera.fy = 0.9 * camera.width;
    camera.cx = 0.5 * (camera.width - 1);
    camera.cy = 0.5 * (camera.height - 1);
    samples.push_back({evidence_of_view(frame, camera, surfaces),
                       share < kRoadShare ? Environment::kRoad : Environment::kStreet});
  }
  return samples;
}

}  // namespace placegraph::apps
