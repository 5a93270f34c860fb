#pragma once
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// One line per keyframe: its frame, all evidence (empty if not measured), the probability of each
/// kind from this view alone, and the accepted kind ("unknown" if none).
std::string environment_csv(const std::vector<EnvironmentObservation>& observations);

/// Numbers of places of each kind and without a kind.
nlohmann::json describe_environments(const PlaceGraph& graph);

}  // namespace placegraph::apps
