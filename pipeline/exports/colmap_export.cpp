#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_model.h>
#include <placegraph/pipeline/exports/colmap_export.h>
#include <placegraph/pipeline/exports/colmap_folder.h>
#include <placegraph/pipeline/exports/keyframe_image_paths.h>
#include <placegraph/pipeline/map/map_bundle.h>

namespace placegraph {
namespace {

/// Ids of images and points are those of keyframes and landmarks plus one: COLMAP's begin at 1.
ColmapModel colmap_model_of(const MapBundle& bundle, const KeyframeImagePaths& images,
                            const Camera& camera) {
  ColmapModel model;
  model.camera = camera;
  for (const MapBundle::View& view : bundle.views) {
    ColmapModel::Image& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(view.keyframe->id.value() + 1);
    image.name = images.name(view.keyframe->frame);
    image.T_world_cam = view.T_map_cam;
    for (const MapBundle::Observation& observation : view.observations)
      image.observations.push_back({observation.px, observation.point});
  }
  for (const MapBundle::Point& point : bundle.points)
    model.points.push_back({static_cast<std::uint64_t>(point.landmark.id.value() + 1),
                            point.landmark.p_map, point.landmark.rgb.value_or(kUnknownColour),
                            point.error_px});
  return model;
}

}  // namespace

ColmapSummary write_colmap(const std::string& folder, const StoredMap& stored, int component,
                           NumberForm form, const std::string& undistorted,
                           const LogSink& log_sink) {
  const KeyframeImagePaths images(stored.origin, undistorted, log_sink);
  const Camera& camera = stored.origin.calibration.value().camera;
  const MapBundle bundle = adjust_map(stored.map, component, camera);
  if (!bundle.outcome) throw NoResult(folder + ": nothing to write: " + bundle.outcome.reason);
  write_colmap_folder(folder, colmap_model_of(bundle, images, camera), form);
  return {.keyframes = bundle.views.size(),
          .points = bundle.points.size(),
          .kept = bundle.kept,
          .observations = bundle.offered,
          .error_before_px = bundle.error_before_px,
          .error_px = bundle.error_px,
          .views = static_cast<double>(bundle.kept) / static_cast<double>(bundle.points.size()),
          .lens_k1 = undistorted.empty() ? stored.origin.lens_k1 : 0};
}

}  // namespace placegraph
