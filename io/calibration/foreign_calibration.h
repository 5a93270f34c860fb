#pragma once
#include <placegraph/io/calibration/raw_camera.h>

#include <optional>
#include <string>

namespace placegraph {

/// The content of another program's calibration file, for one camera or a stereo pair.
struct ForeignCalibration {
  std::string program;  ///< "OpenCV", "ROS", "Kalibr", "ORB-SLAM", "RealSense", "COLMAP"
  RawCamera raw;        ///< width and height are 0 if the file does not contain them
  std::optional<RightCamera> right;  ///< right camera of a pair that is not rectified
  double baseline_m = 0;             ///< baseline of a rectified pair; 0: unknown
  double fps = 0;
  double depth_unit_m = 0;  ///< metres of one step of depth images; 0: unknown
};

/// Reads a calibration in the format of OpenCV (YAML or XML), ROS (camera_info), Kalibr (camchain),
/// ORB-SLAM (YAML), RealSense (JSON) or COLMAP (cameras.txt: its first camera). Returns nothing if
/// the file is in none of these formats. Distortion: none, radial-tangential, rational,
/// equidistant; OpenCV's models of more than eight coefficients if all after the eighth are zero.
/// Of two cameras (Kalibr's cam1, OpenCV's K2 D2 R T) the second is read if `with_right`. Throws
/// FileError, with the line where there is one, if a file in such a format lacks something or has
/// an unknown model.
std::optional<ForeignCalibration> read_foreign_calibration(const std::string& path,
                                                           bool with_right = false);

}  // namespace placegraph
