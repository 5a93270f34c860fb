#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph::apps {

/// The camera of a calibration.yaml, or of one line `fx fy cx cy width height` in a file that ends
/// otherwise. Throws FileError.
Camera read_calib(const std::string& path);

/// The same where what is measured must come from images without distortion: `what` needs that.
Camera read_calib_without_distortion(const std::string& path, const std::string& what);

}  // namespace placegraph::apps
