#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>

namespace placegraph {

/// Cues from which motion is estimated.
struct Cues {
  bool points = true;
  bool lines = false;
  /// The dominant surface: with other cues the ground, for the scale of a monocular camera of known
  /// height; alone the only cue.
  bool plane = true;
  bool manhattan = false;  ///< directions of a Manhattan frame
  bool direct = false;     ///< intensities of several planes, aligned jointly

  /// Whether intensities of surfaces are the only cue.
  bool without_features() const { return !points && !lines && (plane || direct); }
};

/// Parses names joined by commas, as in "points,plane". Throws ArgumentError for an unknown name,
/// for a duplicate, or if none of points, lines, plane and direct is listed.
Cues parse_cues(const std::string& names);

/// Whether lengths are metric from the first frame on: a stereo or depth camera measures them, as
/// does a surface at a known distance if surfaces are the only cue.
bool metric_from_start(const Cues& cues, const Calibration& calibration);

}  // namespace placegraph
