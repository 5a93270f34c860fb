#pragma once
#include <placegraph/frontend/internal/planes/motion_from_planes.h>
#include <placegraph/frontend/internal/planes/planar_regions.h>

#include <cstdint>
#include <optional>
#include <string>

namespace placegraph::apps {

struct PlanesTwoViewArguments {
  std::string in;      ///< file of matches, `xA yA xB yB` a line [px]
  std::string out;     ///< file of labels, one a match: 0 on no plane, 1 the largest plane
  std::string calib;   ///< of the camera of both views, for the motion; empty: no motion is sought
  std::string motion;  ///< JSON file of motion and planes, which needs `calib`; empty: none
  PlanarRegionsOptions regions;
  MotionFromPlanesOptions planes_motion;
  std::uint64_t seed = 1;  ///< of the random samples
  bool force = false;      ///< overwrite `out` and `motion`
};

struct PlanesTwoViewResult {
  std::string in;
  int matches = 0;
  PlanarRegionsResult planes;
  /// Where the camera is known and there are planes. Where there are none and the motion is to be
  /// written all the same: no consensus, without a reason.
  std::optional<MotionFromPlanesResult> motion;
  double cpu_ms = 0;
};

/// `placegraph planes two-view`: the planes behind the matches of two views, and the motion between
/// these. Throws ArgumentError, FileError, and NoAnswer where there are too few matches; then
/// nothing is written. No plane is an answer.
PlanesTwoViewResult planes_two_view(const PlanesTwoViewArguments& arguments);

/// Some lines.
std::string to_text(const PlanesTwoViewResult& result);
std::string to_json(const PlanesTwoViewResult& result);

}  // namespace placegraph::apps
