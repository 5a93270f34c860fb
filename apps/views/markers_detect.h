#pragma once
#include <placegraph/frontend/internal/markers/marker_detector.h>
#include <placegraph/frontend/internal/markers/marker_filter.h>
#include <placegraph/frontend/internal/markers/marker_pose.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Where the origin of pixels is: "centre" of the first pixel, as in the library, or its "corner".
const std::vector<std::string>& pixel_origin_names();

struct MarkersDetectArguments {
  std::string image;
  std::string calib;  ///< of the camera, its principal point counted from `origin`
  std::string dictionary = MarkerLayout().dictionary;
  double side_m = 0;              ///< of the black squares; 0: not known, there are no poses then
  std::string layout;             ///< markers.yaml, in place of the two above; empty: none
  std::string origin = "centre";  ///< one of pixel_origin_names(), also of the corners
  MarkerDetectorOptions options;
  std::string out;      ///< where to_json() of the result is written; empty: nowhere
  std::string drawing;  ///< PNG of the markers; empty: none
  bool force = false;   ///< overwrite `out` and `drawing`
};

/// A marker and what it is known to be.
struct DetectedMarker {
  MarkerObservation observation;  ///< its pixels counted from the first pixel's centre
  double side_m = 0;              ///< 0: not known
  MarkerPoses poses;              ///< both that explain it, where the side is known
};

struct MarkersDetectResult {
  std::string image, dictionary, origin;
  std::vector<DetectedMarker> markers;
  std::optional<MarkerPoseEstimate> camera;  ///< where it is in the layout, if there is one
  double cpu_ms = 0;

  /// What `origin` adds to pixels that are counted from the first pixel's centre.
  double shift_px() const { return origin == "corner" ? 0.5 : 0; }
};

/// `placegraph markers detect`: finds the markers of an image, their poses, and the camera in their
/// layout. Throws ArgumentError, FileError, and NoAnswer where neither a marker nor the camera was
/// found; then nothing is written.
MarkersDetectResult markers_detect(const MarkersDetectArguments& arguments);

/// Some lines.
std::string to_text(const MarkersDetectResult& result);
std::string to_json(const MarkersDetectResult& result);

}  // namespace placegraph::apps
