#pragma once
#include <placegraph/backend/window/window_observations.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Observation of a tracked line in one keyframe.
struct LineInKeyframe {
  KeyframeId keyframe;
  ImageLine::Carriers seen;
  /// In the right camera, or computed from depth.
  std::optional<LineObservation::SecondCamera> second;
};

/// Observations by id of the track, in order of the keyframes.
using LineObservations = std::map<LineId, std::vector<LineInKeyframe>>;

}  // namespace placegraph
