#pragma once
// Inside io only.
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/config/yaml_document.h>

namespace placegraph {

/// OpenCV's YAML of one camera or of two (K1 D1 K2 D2 R T; M1 ... in its own samples), or ROS's
/// camera_info. Returns nothing if the file has no camera matrix under any of the usual keys. The
/// right camera is read if requested. Throws FileError with the line.
std::optional<ForeignCalibration> read_opencv_yaml(const YamlDocument& yaml, bool with_right);

/// OpenCV's XML of one camera. Throws FileError.
ForeignCalibration read_opencv_xml(const std::string& path);

}  // namespace placegraph
