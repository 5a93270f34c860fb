#pragma once
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/graph/geometry/camera.h>

#include <optional>

namespace placegraph::apps {

/// A marker to draw: its outline, its number, and its axes (x red, y green, z blue) if its pose is
/// known.
struct DrawnMarker {
  MarkerObservation observation;
  std::optional<SE3> T_cam_marker;
  double side_m = 0;
};

/// The markers on their image (CV_8UC1), BGR.
Image draw_markers(const Image& grey, const std::vector<DrawnMarker>& markers,
                   const Camera& camera);

}  // namespace placegraph::apps
