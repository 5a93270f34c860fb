#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph {

/// What a motion is seen by.
struct Cues {
  bool points = true;
  bool lines = false;
  /// The dominant surface: beside others the ground, for the unit of a single eye of known height;
  /// alone all that there is.
  bool plane = true;
  bool manhattan = false;  ///< directions of a rectangular world
  bool direct = false;     ///< grey values of several planes, aligned as a whole

  /// Nothing but grey values of surfaces.
  bool surfaces_alone() const { return !points && !lines && (plane || direct); }
};

/// From names joined by commas, as in "points,plane". Throws ArgumentError for an unknown name, one
/// named twice, or if none of points, lines, plane and direct is there.
Cues parse_cues(const std::string& names);

/// Whether lengths are metric from the first frame on: a stereo or depth camera measures them, as
/// does a surface at a known distance if surfaces are the only cue.
bool metric_from_start(const Cues& cues, const Calibration& calibration);

}  // namespace placegraph
