#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Environment evidence and classification of one keyframe.
struct EnvironmentObservation {
  KeyframeId keyframe;           ///< keyframe that was classified
  FrameId frame;                 ///< frame that became the keyframe
  EnvironmentEvidence evidence;  ///< measured features
  /// Probability of each Environment by this keyframe alone; the sum is 1.
  std::array<double, kEnvironmentCount> probabilities{};
  /// Class by this and all earlier keyframes; nothing while it is undecided.
  std::optional<Environment> kind;
};

}  // namespace placegraph
