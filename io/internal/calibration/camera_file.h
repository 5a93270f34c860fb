#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph {

/// A camera without distortion in text: one line `fx fy cx cy width height` [px], blanks or tabs
/// between, `#` before a comment. Throws FileError with the line if there is anything else, or a
/// value that no camera has.
Camera read_camera_file(const std::string& path);

}  // namespace placegraph
