#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_import.h>
#include <placegraph/pipeline/exports/keyframe_image_paths.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace placegraph {
namespace {

/// The images of a model by the frame that each is.
std::map<std::size_t, const ColmapModel::Image*> images_by_frame(const ColmapModel& model,
                                                                 const std::string& sequence,
                                                                 const KeyframeImagePaths& images) {
  std::unordered_map<std::string, std::size_t> frames;
  for (std::size_t i = 0; i < images.dataset().size(); ++i) {
    const std::string name = images.name(FrameId(static_cast<std::int64_t>(i)));
    frames.emplace(name, i);
    frames.emplace(std::filesystem::path(name).filename().string(), i);
  }
  std::map<std::size_t, const ColmapModel::Image*> by_frame;
  for (const ColmapModel::Image& image : model.images) {
    const auto frame = frames.find(image.name);
    require(frame != frames.end(), sequence + ": image " + image.name + " of the model is missing");
    require(by_frame.emplace(frame->second, &image).second,
            "the model has image " + image.name + " twice");
  }
  return by_frame;
}

/// Adds a keyframe that is a place of its own.
Keyframe& add_posed_keyframe(const ColmapModel::Image& image, std::size_t frame,
                             std::int64_t stamp_ns, Map& map) {
  const auto id = static_cast<std::int64_t>(map.keyframes.size());
  Place& place = map.place_graph.places.emplace_back();
  place.id = PlaceId(id);
  place.anchor_keyframe = KeyframeId(id);
  place.T_map_place = image.T_world_cam;
  place.members.push_back({KeyframeId(id), SE3(), 1});
  Keyframe& keyframe = map.keyframes.emplace_back();
  keyframe.id = KeyframeId(id);
  keyframe.frame = FrameId(static_cast<std::int64_t>(frame));
  keyframe.stamp_ns = stamp_ns;
  keyframe.place = place.id;
  return keyframe;
}

/// Adds the points that an image observes, each once; the first image that observes one is its
/// anchor.
void add_observed_points(const ColmapModel& model, const ColmapModel::Image& image,
                         Keyframe& keyframe, std::vector<std::optional<PointLandmark>>& landmarks) {
  std::set<int> observed;
  for (const ColmapModel::Observation& seen : image.observations) {
    if (!observed.insert(seen.point).second) continue;
    const auto at = static_cast<std::size_t>(seen.point);
    const LandmarkId id(seen.point);
    keyframe.observations.push_back({id, seen.px.cast<float>()});
    if (!landmarks[at]) {
      PointLandmark& landmark = landmarks[at].emplace();
      landmark.id = id;
      landmark.keyframe = keyframe.id;
      landmark.point_cam = image.T_world_cam.inverse() * model.points[at].p_world;
      landmark.rgb = model.points[at].rgb;
    }
    ++landmarks[at]->observations;
  }
  std::ranges::sort(keyframe.observations, {}, &LandmarkObservation::landmark);
}

}  // namespace

StoredMap import_colmap(const std::string& folder, const std::string& sequence, bool metric,
                        const LogSink& log) {
  const ColmapModel model = read_colmap(folder);
  if (log && !model.unused_cameras.empty())
    log(LogLevel::kInfo, folder + ": without " + describe_unused_cameras(unused_camera_ids(model)));
  if (model.images.empty()) throw NoResult(folder + ": the model has no image");
  StoredMap stored;
  stored.origin.sequence = sequence;
  stored.origin.calibration.emplace().camera = model.camera;
  const KeyframeImagePaths images(stored.origin);
  const Dataset& dataset = images.dataset();
  const Camera camera = dataset.calibration(dataset.sensors().back()).camera;
  require(camera.width == model.camera.width && camera.height == model.camera.height,
          fmt::format("{}: images of {}x{}, the model's camera has {}x{}", sequence, camera.width,
                      camera.height, model.camera.width, model.camera.height));

  const auto by_frame = images_by_frame(model, sequence, images);
  std::vector<std::optional<PointLandmark>> landmarks(model.points.size());
  Map& map = stored.map;
  map.metric = metric;
  for (std::size_t i = 0; i < dataset.size(); ++i) {
    FrameRecord& frame = map.frames.emplace_back();
    frame.frame = FrameId(static_cast<std::int64_t>(i));
    frame.stamp_ns = dataset.stamp_ns(i);
    StampedPose& online = map.trajectory_online.poses.emplace_back();
    online.stamp_ns = frame.stamp_ns;
    const auto found = by_frame.find(i);
    if (found == by_frame.end()) {
      frame.reason = "not an image of the model";
      continue;
    }
    const ColmapModel::Image& image = *found->second;
    Keyframe& keyframe = add_posed_keyframe(image, i, frame.stamp_ns, map);
    add_observed_points(model, image, keyframe, landmarks);
    frame.keyframe = keyframe.id;
    frame.T_keyframe_frame = SE3();
    frame.inliers = static_cast<int>(keyframe.observations.size());
    online.T_world_body = image.T_world_cam.isometry();
  }
  for (const auto& landmark : landmarks)
    if (landmark) map.landmarks.push_back(*landmark);
  return stored;
}

}  // namespace placegraph
