#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the camera of a calibration file.
///
/// The file is a calibration.yaml, one of another program (OpenCV, ROS, Kalibr, ORB-SLAM,
/// RealSense, COLMAP), or a line `fx fy cx cy width height` [px]. Throws FileError, also for a file
/// without the size of the images and for a lens of the rational model, which Camera does not have.
Camera read_calibration(const std::string& path);

}  // namespace placegraph
