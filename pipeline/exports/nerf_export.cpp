#include <placegraph/io/exports/nerf_transforms.h>
#include <placegraph/pipeline/exports/keyframe_image_paths.h>
#include <placegraph/pipeline/exports/nerf_export.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <filesystem>

namespace placegraph {

std::string nerf_transforms(const std::string& path, const StoredMap& stored, int component,
                            const std::string& undistorted, const LogSink& log_sink) {
  namespace fs = std::filesystem;
  const KeyframeImagePaths images(stored.origin, undistorted, log_sink);
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  std::vector<NerfImage> frames;
  for (const PosedKeyframe& posed : geometry_of(stored.map, component).keyframes)
    frames.push_back({fs::absolute(images.path(posed.keyframe->frame))
                          .lexically_normal()
                          .lexically_relative(folder)
                          .string(),
                      posed.T_map_cam});
  return to_nerf_transforms(stored.origin.calibration.value().camera, frames);
}

}  // namespace placegraph
