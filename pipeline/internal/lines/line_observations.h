#pragma once
#include <placegraph/backend/internal/window/window_observations.h>
#include <placegraph/frontend/internal/lines/line_triangulation.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// What one keyframe saw of a line that is followed.
struct LineInKeyframe {
  KeyframeId keyframe;
  ImageLine::Carriers seen;
  std::optional<LineObservation::SecondCamera> second;  ///< by the right camera, or made from depth
};

/// By id of the track, in order of the keyframes.
using LineObservations = std::map<LineId, std::vector<LineInKeyframe>>;

}  // namespace placegraph
