#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph::apps {

/// read_calibration() for commands that need images without distortion.
/// `what` begins the message. Throws FileError.
Camera read_calib_without_distortion(const std::string& path, const std::string& what);

}  // namespace placegraph::apps
