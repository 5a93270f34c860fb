#pragma once
#include <placegraph/io/internal/calibration/raw_camera.h>

#include <optional>
#include <string>

namespace placegraph {

/// What the calibration file of another program says of one camera, or of two eyes.
struct ForeignCalibration {
  std::string program;  ///< "OpenCV", "ROS", "Kalibr", "ORB-SLAM", "RealSense", "COLMAP"
  RawCamera raw;        ///< width and height 0 where the file does not tell them
  std::optional<RightCamera> right;  ///< of eyes that are not rectified
  double baseline_m = 0;             ///< of rectified eyes; 0: not told
  double fps = 0;
  double depth_unit_m = 0;  ///< metres of one step of depth images; 0: not told
};

/// Reads a calibration in the form of OpenCV (YAML or XML), ROS (camera_info), Kalibr (camchain),
/// ORB-SLAM (YAML), RealSense (JSON) or COLMAP (cameras.txt: its first camera). Nothing if
/// the file is of none of these forms. Distortion: none, radial-tangential, rational, equidistant;
/// OpenCV's models of more than eight coefficients where all behind the eighth are zero. Of two
/// cameras (Kalibr's cam1, OpenCV's K2 D2 R T) the second is read if `with_right`. Throws
/// FileError, with the line where there is one, if a file of such a form lacks something or has a
/// model that is not known here.
std::optional<ForeignCalibration> read_foreign_calibration(const std::string& path,
                                                           bool with_right = false);

}  // namespace placegraph
