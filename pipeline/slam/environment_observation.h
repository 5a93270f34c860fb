#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// What one keyframe shows of the environment it was taken in.
struct EnvironmentObservation {
  KeyframeId keyframe;           ///< the keyframe that was classified
  FrameId frame;                 ///< the frame that became the keyframe
  EnvironmentEvidence evidence;  ///< the measured features
  /// Of each Environment, by this keyframe alone; they sum to 1.
  std::array<double, kEnvironmentCount> probabilities{};
  /// The kind by this and all earlier keyframes; nothing while it is undecided.
  std::optional<Environment> kind;
};

}  // namespace placegraph
