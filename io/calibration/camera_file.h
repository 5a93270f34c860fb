#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph {

/// A camera without distortion as text: one line `fx fy cx cy width height` [px], separated by
/// blanks or tabs, `#` before a comment. Throws FileError with the line if there is anything else,
/// or a value that is impossible for a camera.
Camera read_camera_file(const std::string& path);

}  // namespace placegraph
