#pragma once
#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/frontend/planes/planar_regions.h>

#include <cstdint>
#include <optional>
#include <string>

namespace placegraph::apps {

struct PlanesTwoViewArguments {
  std::string in;      ///< file of matches, `xA yA xB yB` per line [px]
  std::string out;     ///< file for labels, one per match: 0 no plane, 1 the largest plane
  std::string calib;   ///< calibration of both views, for the motion; empty: no motion
  std::string motion;  ///< JSON file for the motion and the planes, requires `calib`; empty: none
  PlanarRegionsOptions regions;
  MotionFromPlanesOptions planes_motion;
  std::uint64_t seed = 1;  ///< seed of the random samples
  bool force = false;      ///< overwrite `out` and `motion`
};

struct PlanesTwoViewResult {
  std::string in;
  int matches = 0;
  PlanarRegionsResult planes;
  /// Set if the camera is known and there are planes.
  /// Without planes, if the motion is to be written nevertheless: no consensus, without a reason.
  std::optional<MotionFromPlanesResult> motion;
  double cpu_ms = 0;
};

/// Labels the matches of two views by their planes: `placegraph image two-view-planes`.
/// With a camera, estimates the motion from the planes. Throws ArgumentError, FileError, and
/// NoResult if there are too few matches; then nothing is written. A result without planes is
/// valid.
PlanesTwoViewResult planes_two_view(const PlanesTwoViewArguments& arguments);

/// Some lines.
std::string to_text(const PlanesTwoViewResult& result);
std::string to_json(const PlanesTwoViewResult& result);

}  // namespace placegraph::apps
