#pragma once
#include <string>

namespace placegraph {

/// What a motion is seen by.
struct Cues {
  bool points = true;
  bool lines = false;
  bool plane = true;       ///< the ground, aligned directly, where the camera's height is known
  bool manhattan = false;  ///< directions of a rectangular world
  bool direct = false;     ///< grey values of planes, aligned as a whole
};

/// From names joined by commas, as in "points,plane". Throws ArgumentError for an unknown name, one
/// that this version cannot use, one named twice, or if neither points nor lines are left.
Cues parse_cues(const std::string& names);

}  // namespace placegraph
