#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/io/calibration/raw_camera.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// The depth part of a calibration.yaml. Without `fx` the depth images are registered to the (raw,
/// distorted) image and share its camera.
struct DepthYaml {
  double unit_m = 0.001;  ///< metres of one step
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::vector<double> T_cam_depth;  ///< 12 numbers, row-major 3x4; empty: identity
  double sigma_at_1m = 0.005;
};
void visit(OptionVisitor& field, DepthYaml& yaml);

/// The content of `calibration.yaml`, with the keys of docs/datasets.md. 0 or empty: not given.
struct CalibrationYaml {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  Distortion distortion = Distortion::kNone;
  std::vector<double> coefficients;
  double baseline_m = 0, camera_height_m = 0, fps = 0;
  DepthYaml depth;

  /// Right camera of a pair that is not rectified, from calibration formats of other programs.
  std::optional<RightCamera> right;

  RawCamera camera() const;
  DepthCamera depth_camera() const;
};
void visit(OptionVisitor& field, CalibrationYaml& yaml);

/// Reads that format, or one of another program (read_foreign_calibration), which may leave width
/// and height 0; see fit_to_image. The right camera is that of images in right/ beside the file.
/// Strict: unknown keys, wrong types and values out of range are FileErrors with the line; so are
/// missing width, height, fx, fy, cx, cy, and coefficients that do not fit the distortion model.
/// Keys that are missing in the file keep their values in `yaml`.
void read_calibration_yaml(const std::string& path, CalibrationYaml& yaml);

}  // namespace placegraph
