#include "apps/support/read_calib.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/read_calibration.h>

namespace placegraph::apps {

Camera read_calib_without_distortion(const std::string& path, const std::string& what) {
  const Camera camera = read_calibration(path);
  if (camera.distortion != Distortion::kNone)
    throw FileError(path, what + " a camera without distortion");
  return camera;
}

}  // namespace placegraph::apps
