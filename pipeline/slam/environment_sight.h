#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// What one keyframe says of its surroundings.
struct EnvironmentSight {
  KeyframeId keyframe;
  FrameId frame;
  EnvironmentEvidence evidence;
  std::array<double, kEnvironmentCount> probabilities{};  ///< by this view alone
  std::optional<Environment> kind;                        ///< with those before it
};

}  // namespace placegraph
