#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>

namespace placegraph {

/// Throws ArgumentError unless the images of a frame have the sizes of their cameras and the types
/// that Frame promises.
void check_images(const Frame& frame, const Calibration& calibration);

}  // namespace placegraph
