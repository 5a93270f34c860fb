#include "apps/map/queries/query_images.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/camera_change.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/lens_correction.h>

#include <filesystem>
#include <memory>

#include "apps/support/image_range.h"

namespace placegraph::apps {
namespace {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string query_camera_text(const Camera& camera) {
  return fmt::format("{} x {} px, fx {:.1f}, fy {:.1f}, cx {:.1f}, cy {:.1f}", camera.width,
                     camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
}

QueryImages bare_images(const std::string& path, const std::vector<int>& range) {
  const ImageRange images = images_of(path, range);
  return {images.paths.size(),
          images.first,
          [images](std::size_t i) { return read_frame(images, i); },
          [images](std::size_t i) { return file_name(images.paths[i]); },
          {}};
}

/// The first image that can be read; an empty one if there is none.
Image first_readable(const QueryImages& images) {
  for (std::size_t i = 0; i < images.count; ++i) try {
      return images.frame(i).image;
    } catch (const FileError&) {
    }
  return {};
}

/// Images without a calibration; those of the size of the map's images are assumed to be from its
/// camera.
QueryImages images_without_camera(const std::string& path, const std::vector<int>& range,
                                  const Camera& map_camera) {
  QueryImages images = bare_images(path, range);
  const Image first = first_readable(images);
  if (!first.empty())
    images.notes.push_back(
        first.cols == map_camera.width && first.rows == map_camera.height
            ? "no camera is given; images of the map's size are taken for the map's, without "
              "distortion"
            : "no camera is given (calibration.yaml), and these images have not the size of the "
              "map's: no poses");
  return images;
}

/// The distortion that the run of the map estimated, if the images are from the same camera.
std::optional<LensCorrection> lens_of_map(const Calibration& given, const MapOrigin& origin) {
  if (origin.lens_k1 == 0) return std::nullopt;
  LensCorrection lens(given);
  lens.add(origin.lens_k1);
  const CameraChange change(lens.calibration().camera, origin.calibration->camera);
  if (!change.is_identity()) return std::nullopt;
  return lens;
}

std::string change_text(const Camera& camera, const Camera& map_camera, double seen_share) {
  return fmt::format(
      "another camera ({}) than the map's ({}): its images are resampled to the map's, of which "
      "they show {:.0f} %",
      query_camera_text(camera), query_camera_text(map_camera), 100 * seen_share);
}

}  // namespace

QueryImages query_images(const std::string& path, const std::vector<int>& range,
                         const MapOrigin& origin) {
  if (!origin.calibration) return bare_images(path, range);
  const Camera& map_camera = origin.calibration->camera;
  std::shared_ptr<const Dataset> dataset;
  try {
    dataset = open_dataset(path);
  } catch (const UnknownLayout&) {
    return images_without_camera(path, range, map_camera);
  }
  QueryImages images;
  const auto [first, last] = selected_range(range, dataset->size());
  images.first = first;
  images.count = static_cast<std::size_t>(last - first + 1);
  for (const DataNote& note : dataset->notes()) images.notes.push_back(note.text);
  const Calibration given = dataset->calibration(Sensor::kMono);
  const auto lens = lens_of_map(given, origin);
  const auto change = std::make_shared<const CameraChange>(
      lens ? lens->calibration().camera : given.camera, map_camera);
  if (!change->is_identity())
    images.notes.push_back(change_text(given.camera, map_camera, change->seen_share()));
  const Sensor sensor = change->is_identity() ? dataset->sensors().front() : Sensor::kMono;
  images.frame = [=, first = static_cast<std::size_t>(first)](std::size_t i) {
    Frame frame = dataset->frame(first + i, sensor);
    if (lens) lens->apply(frame);
    change->apply(frame);
    return frame;
  };
  images.name = [dataset, first = static_cast<std::size_t>(first)](std::size_t i) {
    return file_name(dataset->image_path(first + i));
  };
  return images;
}

}  // namespace placegraph::apps
