#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph::apps {

/// Reads a camera: a calibration.yaml, or one line `fx fy cx cy width height` in other files.
/// Throws FileError.
Camera read_calib(const std::string& path);

/// The same for commands that need images without distortion; `what` begins the message.
Camera read_calib_without_distortion(const std::string& path, const std::string& what);

}  // namespace placegraph::apps
