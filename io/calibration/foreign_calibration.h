#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <optional>
#include <string>

namespace placegraph {

/// What the calibration file of another program says of one camera.
struct ForeignCalibration {
  std::string program;    ///< "OpenCV", "ROS", "Kalibr", "ORB-SLAM", "RealSense", "COLMAP"
  Camera camera;          ///< width and height 0 where the file does not tell them
  double baseline_m = 0;  ///< of rectified eyes; 0: not told
  double fps = 0;
  double depth_unit_m = 0;  ///< metres of one step of depth images; 0: not told
};

/// Reads a calibration in the form of OpenCV (YAML or XML), ROS (camera_info), Kalibr (camchain:
/// cam0), ORB-SLAM (YAML), RealSense (JSON) or COLMAP (cameras.txt: its first camera). Nothing if
/// the file is of none of these forms. Distortion: none, radial-tangential, equidistant; OpenCV's
/// models of eight and more coefficients where all behind the fifth are zero. Throws FileError,
/// with the line where there is one, if a file of such a form lacks something or has a model that
/// is not known here.
std::optional<ForeignCalibration> read_foreign_calibration(const std::string& path);

/// Puts the coefficients of a radial-tangential model, in OpenCV's order, into a camera. Throws
/// ArgumentError unless there are four, five, or more that are zero behind the fifth.
void set_radial_tangential(const std::vector<double>& coefficients, Camera& camera);

}  // namespace placegraph
