#pragma once
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <cstdint>
#include <optional>

namespace placegraph {

/// What one keyframe says of its surroundings.
struct EnvironmentSight {
  std::int64_t keyframe = 0, frame = 0;
  EnvironmentEvidence evidence;
  std::array<double, kEnvironmentCount> probabilities{};  ///< by this view alone
  std::optional<Environment> kind;                        ///< with those before it
};

}  // namespace placegraph
