#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/pipeline/exports/keyframe_frames.h>
#include <placegraph/pipeline/exports/keyframe_image_paths.h>
#include <placegraph/pipeline/lens_correction.h>

#include <filesystem>

namespace placegraph {

PosedImages posed_images(const StoredMap& stored, const MapGeometry& geometry) {
  const MapOrigin& origin = stored.origin;
  const std::shared_ptr<const Dataset> dataset = open_dataset(origin.sequence);
  LensCorrection lens(dataset->calibration(origin.sensor));
  if (origin.lens_k1 != 0) lens.add(origin.lens_k1);
  for (const PosedKeyframe& posed : geometry.keyframes)
    require(posed.keyframe->frame.value() >= 0 &&
                static_cast<std::size_t>(posed.keyframe->frame.value()) < dataset->size(),
            fmt::format("{}: it has no frame {}, which is a keyframe of the map", origin.sequence,
                        posed.keyframe->frame.value()));
  return {geometry.keyframes, origin.calibration.value(),
          [dataset, lens, sensor = origin.sensor](const Keyframe& keyframe) {
            Frame frame = dataset->frame(static_cast<std::size_t>(keyframe.frame.value()), sensor);
            lens.apply(frame);
            frame.colour = frame.colour.empty() ? frame.colour : lens.corrected(frame.colour);
            return frame;
          }};
}

std::size_t write_undistorted(const std::string& folder, const StoredMap& stored, int component) {
  namespace fs = std::filesystem;
  const PosedImages images = posed_images(stored, geometry_of(stored.map, component));
  const KeyframeImagePaths names(stored.origin, folder);
  const OutputFolder made(folder);
  std::vector<std::string> written;
  try {
    for (const PosedKeyframe& posed : images.keyframes) {
      const Frame frame = images.frame_of(*posed.keyframe);
      const std::string path = names.path(posed.keyframe->frame);
      fs::create_directories(fs::path(path).parent_path());
      write_png(path, frame.colour.empty() ? frame.image : frame.colour);
      written.push_back(path);
    }
  } catch (...) {
    std::error_code ignored;
    for (const std::string& path : written) {
      fs::remove(path, ignored);
      fs::remove(fs::path(path).parent_path(), ignored);
    }
    throw;
  }
  return written.size();
}

}  // namespace placegraph
