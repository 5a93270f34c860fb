#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/camera_file.h>
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/calibration/read_calibration.h>

#include <filesystem>

namespace placegraph {

Camera read_calibration(const std::string& path) {
  const std::string kind = std::filesystem::path(path).extension().string();
  RawCamera raw;
  if (kind == ".yaml" || kind == ".yml" || kind == ".xml" || kind == ".json") {
    CalibrationYaml yaml;
    read_calibration_yaml(path, yaml);
    raw = yaml.camera();
  } else if (const auto foreign = read_foreign_calibration(path)) {
    raw = foreign->raw;
  } else {
    return read_camera_file(path);
  }
  if (raw.is_rational())
    throw FileError(path,
                    "rational distortion (k4, k5, k6) is not supported here: undistort the images");
  const Camera& camera = raw.camera;
  if (camera.width == 0 || camera.height == 0) throw FileError(path, "has no image size");
  return camera;
}

}  // namespace placegraph
