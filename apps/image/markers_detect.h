#pragma once
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_pose.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the pixel origin: "centre" of the first pixel, as in the library, or its "corner".
const std::vector<std::string>& pixel_origin_names();

struct MarkersDetectArguments {
  std::string image;
  std::string calib;  ///< calibration of the camera, with the principal point relative to `origin`
  std::string dictionary = MarkerLayout().dictionary;
  double side_m = 0;              ///< side of the black squares; 0: unknown, no poses
  std::string layout;             ///< markers.yaml instead of the two members above; empty: none
  std::string origin = "centre";  ///< one of pixel_origin_names(); also the origin of the corners
  MarkerDetectorOptions options;
  std::string out;      ///< file for to_json() of the result; empty: none
  std::string drawing;  ///< file for a drawing of the markers, PNG; empty: none
  bool force = false;   ///< overwrite `out` and `drawing`
};

/// A detected marker with its side and its poses.
struct DetectedMarker {
  MarkerObservation observation;  ///< pixel coordinates relative to the first pixel's centre
  double side_m = 0;              ///< side [m]; 0: unknown
  MarkerPoses poses;              ///< both poses that explain it, if the side is known
};

struct MarkersDetectResult {
  std::string image, dictionary, origin;
  std::vector<DetectedMarker> markers;
  std::optional<LayoutPose> camera;  ///< pose in the layout, if there is one
  double cpu_ms = 0;

  /// Offset of `origin` from the first pixel's centre.
  double shift_px() const { return origin == "corner" ? 0.5 : 0; }
};

/// Detects markers, their poses, and the camera in their layout: `placegraph image markers`.
/// Throws ArgumentError, FileError, and NoResult if neither a marker nor the camera was found; then
/// nothing is written.
MarkersDetectResult markers_detect(const MarkersDetectArguments& arguments);

/// Some lines.
std::string to_text(const MarkersDetectResult& result);
std::string to_json(const MarkersDetectResult& result);

}  // namespace placegraph::apps
