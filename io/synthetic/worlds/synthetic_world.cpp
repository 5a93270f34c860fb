#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/scene/labelled_mesh.h>
#include <placegraph/io/synthetic/defects/camera_motion.h>
#include <placegraph/io/synthetic/render/depth_sensor.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/render/rolling_shutter.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace placegraph {

using synthetic::Tour;
using synthetic::TourRequest;
using synthetic::View;

namespace {

struct BuiltIn {
  const char* name;
  Tour (*make)(const TourRequest&);
  const char* former_name = nullptr;  ///< still understood
};
constexpr BuiltIn kWorlds[] = {{"town-loop", synthetic::make_town_loop},
                               {"repeated-blocks", synthetic::make_repeated_blocks},
                               {"corridor-loop", synthetic::make_corridor_loop},
                               {"warehouse", synthetic::make_warehouse},
                               {"turning-walk", synthetic::make_turning_walk},
                               {"flight", synthetic::make_flight_world, "hover"}};

const BuiltIn* built_in(const std::string& name) {
  for (const BuiltIn& world : kWorlds)
    if (name == world.name || (world.former_name != nullptr && name == world.former_name))
      return &world;
  return nullptr;
}

Tour make_tour(const SyntheticOptions& options) {
  const TourRequest request{options.seed, synthetic::sensor_model(options.difficulty),
                            options.duration_s, options.defects.undulation_m};
  if (const BuiltIn* world = built_in(options.world)) return world->make(request);
  if (!std::filesystem::exists(options.world)) {
    std::string names;
    for (const BuiltIn& world : kWorlds)
      names += std::string(names.empty() ? "" : ", ") + world.name;
    throw ArgumentError("world '" + options.world + "': neither a pose file nor one of " + names);
  }
  return synthetic::make_drive(options.world, request);
}

void resize(Camera& camera, int width, int height) {
  const double sx = 1.0 * width / camera.width, sy = 1.0 * height / camera.height;
  camera.fx *= sx;
  camera.fy *= sy;
  camera.cx = (camera.cx + 0.5) * sx - 0.5;  // pixel centres are at integers
  camera.cy = (camera.cy + 0.5) * sy - 0.5;
  camera.width = width;
  camera.height = height;
}

}  // namespace

void SyntheticOptions::check() const {
  check_ranges(*this);
  require(!world.empty(), "world: is empty");
  const BuiltIn* named = built_in(world);
  require(duration_s == 0 || (named != nullptr && named->make == synthetic::make_flight_world),
          "duration_s: only for the world `flight`");
  require(
      defects.undulation_m == 0 || named == nullptr || named->make == synthetic::make_town_loop,
      "defects.undulation_m: only for `town-loop` and pose files; elsewhere it must be 0, beside "
      "hard-drive, too");
  require((width == 0) == (height == 0), "size: width and height go together");
  require(width == 0 || (width >= 32 && height >= 32), "size: at least 32 x 32");
}

void visit(OptionVisitor& field, SyntheticOptions& o) {
  field("world", o.world,
        "name of a built-in world (docs/synthetic_world.md) or path of a KITTI pose file");
  field.choice("difficulty", o.difficulty, {"clean", "standard", "hard"},
               "level of noise, exposure drift, motion blur, contrast and traffic");
  field("seed", o.seed, "seed of textures, scenery, traffic and noise");
  field("frames", o.frames, "maximum number of frames from the start; 0 = all", {0, 1e9});
  field("duration_s", o.duration_s, "duration of the flight [s], world `flight` only; 0 = 120",
        {0, 3600});
  field("width", o.width, "image width [px]; 0 = width of the world's camera", {0, 16384});
  field("height", o.height, "image height [px]; 0 = height of the world's camera", {0, 16384});
  field("threads", o.threads, "number of threads of one rendering", {1, 256});
  field.group("defects", o.defects, "how images and calibration differ from what is written");
}

const std::vector<std::string>& SyntheticWorld::worlds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const BuiltIn& world : kWorlds) list.emplace_back(world.name);
    return list;
  }();
  return names;
}

SyntheticWorld::SyntheticWorld(const SyntheticOptions& options) : options_(options) {
  options_.check();
  synthetic::SensorModel sensor = synthetic::sensor_model(options_.difficulty);
  if (options_.defects.shutter_s > 0) sensor.shutter_s = options_.defects.shutter_s;
  sensor_ = std::make_unique<const synthetic::SensorModel>(sensor);
  Tour tour = make_tour(options_);
  if (options_.width > 0) resize(tour.camera, options_.width, options_.height);
  tour_ = std::make_unique<const Tour>(std::move(tour));
}

SyntheticWorld::~SyntheticWorld() = default;
SyntheticWorld::SyntheticWorld(SyntheticWorld&&) noexcept = default;
SyntheticWorld& SyntheticWorld::operator=(SyntheticWorld&&) noexcept = default;

const std::string& SyntheticWorld::name() const { return tour_->name; }

std::size_t SyntheticWorld::size() const {
  const std::size_t all = tour_->T_scene_cam.size();
  return options_.frames > 0 ? std::min(all, static_cast<std::size_t>(options_.frames)) : all;
}

Calibration SyntheticWorld::calibration() const {
  Calibration calibration;
  calibration.camera = tour_->camera;
  calibration.baseline_m = tour_->baseline_m;
  calibration.depth = DepthCamera{tour_->camera, SE3(), 0.001};
  if (tour_->camera_height_m > 0) calibration.camera_height_m = tour_->camera_height_m;
  return synthetic::miscalibrated(calibration, options_.defects.calibration_error, options_.seed);
}

double SyntheticWorld::exposure_time_s(std::size_t index) const {
  const double jitter_s = options_.defects.time_jitter_s;
  if (jitter_s == 0) return tour_->time_s.at(index);
  Random random(options_.seed * 1000003 + index, 71);
  return tour_->time_s.at(index) + random.normal(0, jitter_s);
}

std::int64_t SyntheticWorld::stamp_ns(std::size_t index) const {
  return static_cast<std::int64_t>(std::llround(tour_->time_s.at(index) * 1e9));
}

Trajectory SyntheticWorld::ground_truth() const {
  Trajectory out;
  const SE3 T_first_scene = tour_->T_scene_cam.front().inverse();
  for (std::size_t i = 0; i < size(); ++i) {
    const SE3 T = i == 0 ? SE3() : T_first_scene * tour_->T_scene_cam[i];
    out.poses.push_back({stamp_ns(i), T.isometry()});
  }
  return out;
}

View SyntheticWorld::view(std::size_t index, bool right, double delay_s) const {
  const double time_s = exposure_time_s(index) + delay_s;
  View view{tour_->camera, synthetic::pose_at(tour_->time_s, tour_->T_scene_cam, time_s), time_s};
  if (right)
    view.T_scene_cam = view.T_scene_cam * SE3(SO3(), Eigen::Vector3d(tour_->baseline_m, 0, 0));
  return view;
}

synthetic::Rendering SyntheticWorld::see(std::size_t index, bool right) const {
  const auto contrast = static_cast<float>(sensor_->contrast);
  const double readout_s = options_.defects.rolling_shutter_s;
  if (readout_s == 0)
    return synthetic::render(tour_->scene, view(index, right), contrast, false, options_.threads);
  const auto view_after = [&](double delay_s) { return view(index, right, delay_s); };
  return synthetic::render_rolling(tour_->scene, view_after, readout_s, contrast, options_.threads);
}

Image SyntheticWorld::expose(std::size_t index, bool right,
                             const synthetic::Rendering& rendering) const {
  const View at = view(index, right);
  const std::size_t last = tour_->T_scene_cam.size() - 1;
  const std::size_t a = index > 0 ? index - 1 : 0, b = std::min(index + 1, last);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = velocity;
  if (!tour_->velocity_cam.empty()) {
    velocity = tour_->velocity_cam[index].head<3>();
    angular_velocity = tour_->velocity_cam[index].tail<3>();
  } else if (b > a) {
    // Central differences; rotations between frames are small enough for R^T R' = I + [w dt].
    const View before = view(a, right), after = view(b, right);
    const double dt = after.time_s - before.time_s;
    const Eigen::Matrix3d R = at.T_scene_cam.rotation().matrix();
    velocity =
        R.transpose() * (after.T_scene_cam.translation() - before.T_scene_cam.translation()) / dt;
    const Eigen::Matrix3d step =
        before.T_scene_cam.rotation().matrix().transpose() * after.T_scene_cam.rotation().matrix();
    angular_velocity =
        Eigen::Vector3d(step(2, 1) - step(1, 2), step(0, 2) - step(2, 0), step(1, 0) - step(0, 1)) /
        (2 * dt);
  }
  const auto velocities = synthetic::point_velocities(tour_->scene, at, velocity, angular_velocity);
  return synthetic::expose(rendering, at, velocities, *sensor_, frame_seed(index, right ? 1 : 0),
                           static_cast<std::uint32_t>(options_.seed) + 99U);
}

std::uint32_t SyntheticWorld::frame_seed(std::size_t index, int image) const {
  const auto seed = static_cast<std::uint32_t>(options_.seed);
  return synthetic::hash_cell(static_cast<int>(index), image, seed * 7919U + 13U);
}

Image SyntheticWorld::measure_depth(std::size_t index, const synthetic::Rendering& at_image) const {
  const SyntheticDefects& d = options_.defects;
  const View seen = view(index, false, -d.depth_lag_s);
  const Image inverse_depth =
      d.depth_lag_s == 0
          ? at_image.inverse_depth
          : synthetic::render(tour_->scene, seen, 1, false, options_.threads).inverse_depth;
  const synthetic::DepthSensor sensor{
      .step = d.depth_quantization,
      .noise = d.depth_noise,
      .holes = d.depth_holes,
      .flying_pixels = d.flying_pixels,
      .scale = 1 + Random(options_.seed, 81).normal(0, d.depth_scale_error)};
  return synthetic::measure_depth(inverse_depth, seen, sensor, frame_seed(index, 2),
                                  static_cast<std::uint32_t>(options_.seed) + 199U);
}

SyntheticFrame SyntheticWorld::render(std::size_t index, const SyntheticContents& contents) const {
  require(index < size(), "synthetic world: frame index out of range");
  const View left = view(index, false);
  const bool rolling = options_.defects.rolling_shutter_s > 0;
  const bool maps = contents.labels || contents.planes;
  synthetic::Rendering rendering;  // all rows at one time
  if (!rolling || maps || contents.depth || contents.flow)
    rendering = synthetic::render(tour_->scene, left, static_cast<float>(sensor_->contrast), maps,
                                  options_.threads);
  SyntheticFrame out;
  out.frame.id = FrameId(index);
  out.frame.stamp_ns = stamp_ns(index);
  out.frame.image =
      rolling ? expose(index, false, see(index, false)) : expose(index, false, rendering);
  if (contents.right) out.frame.right = expose(index, true, see(index, true));
  if (contents.depth) out.frame.depth = measure_depth(index, rendering);
  if (contents.labels) out.labels = rendering.labels;
  if (contents.planes) out.planes = rendering.planes;
  if (contents.flow && index + 1 < size())
    out.flow = synthetic::flow_image(tour_->scene, rendering, left, view(index + 1, false));
  return out;
}

Frame SyntheticWorld::view_from(const SE3& T_plan_cam) const {
  const Eigen::Vector3d origin = tour_->T_scene_cam.front().translation();
  const View view{tour_->camera, SE3(T_plan_cam.rotation(), origin + T_plan_cam.translation()), 0};
  const synthetic::Rendering rendering =
      synthetic::render(tour_->scene, view, 1, false, options_.threads);
  Frame frame;
  frame.depth = synthetic::depth_image(rendering);
  rendering.grey.convertTo(frame.image, CV_8UC1, 255);
  return frame;
}

std::vector<std::string> SyntheticWorld::class_names() {
  std::vector<std::string> names;
  for (int i = 0; i < static_cast<int>(synthetic::SurfaceClass::kCount); ++i)
    names.emplace_back(to_string(static_cast<synthetic::SurfaceClass>(i)));
  return names;
}

std::vector<Eigen::Vector4d> SyntheticWorld::planes() const {
  std::vector<Eigen::Vector4d> out = tour_->scene.planes;
  const SE3& T_scene_first = tour_->T_scene_cam.front();
  for (Eigen::Vector4d& plane : out) {
    const Eigen::Vector3d n = plane.head<3>();
    plane[3] -= n.dot(T_scene_first.translation());
    plane.head<3>() = T_scene_first.rotation().inverse() * n;
  }
  return out;
}

std::vector<SceneClass> SyntheticWorld::scene_classes() {
  const auto surface = [](const std::string& name) {
    if (name == "Sky") return Surface::kSky;
    if (name == "Road" || name == "Pavement") return Surface::kGround;
    return name == "Car" ? Surface::kObject : Surface::kVertical;
  };
  std::vector<SceneClass> classes;
  for (int i = 0; i < static_cast<int>(synthetic::SurfaceClass::kCount); ++i) {
    const auto label = static_cast<synthetic::SurfaceClass>(i);
    if (const char* urban = synthetic::street_class_name(label))
      classes.push_back({i, urban, surface(urban)});
    else
      classes.push_back({i, to_string(label), std::nullopt});
  }
  return classes;
}

LabelledMesh SyntheticWorld::static_mesh() const {
  LabelledMesh mesh;
  std::vector<int> number;
  for (int i = 0; i < static_cast<int>(synthetic::SurfaceClass::kCount); ++i) {
    const auto label = static_cast<synthetic::SurfaceClass>(i);
    const char* urban = synthetic::street_class_name(label);
    const std::string name = urban ? urban : to_string(label);
    const auto found = std::find(mesh.classes.begin(), mesh.classes.end(), name);
    number.push_back(static_cast<int>(found - mesh.classes.begin()));
    if (found == mesh.classes.end()) mesh.classes.push_back(name);
  }
  const SE3 T_first_scene = tour_->T_scene_cam.front().inverse();
  for (const synthetic::Part& part : tour_->scene.parts)
    for (const synthetic::Face& from : part.faces) {
      LabelledMesh::Face face;
      face.label = number[static_cast<std::size_t>(from.label)];
      for (int i = 0; i < from.count; ++i) {
        face.corners.push_back(static_cast<int>(mesh.vertices.size()));
        mesh.vertices.emplace_back(T_first_scene * from.corners[static_cast<std::size_t>(i)]);
      }
      mesh.faces.push_back(std::move(face));
    }
  return mesh;
}

const std::string& SyntheticWorld::floor_plan() const { return tour_->floor_plan; }
const synthetic::FlightSetting* SyntheticWorld::flight_setting() const {
  return tour_->flight_setting.get();
}
bool SyntheticWorld::is_indoor() const { return !tour_->scene.outdoor; }

}  // namespace placegraph
