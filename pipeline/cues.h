#pragma once
#include <string>

namespace placegraph {

/// What a motion is seen by.
struct Cues {
  bool points = true;
  bool lines = false;
  bool plane =
      true;  ///< the ground as a plane, aligned directly, where the camera's height is known
};

/// From names joined by commas, as in "points,plane". Throws ArgumentError for an unknown name, one
/// named twice, or if neither points nor lines are left.
Cues parse_cues(const std::string& names);

}  // namespace placegraph
