#pragma once
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A line a keyframe: its frame, all evidence (empty where it was not looked at), the probability
/// of each kind by this view alone, and the kind that was taken ("unknown" if none).
std::string environment_csv(const std::vector<EnvironmentObservation>& observations);

/// Places of each kind, and those without one.
nlohmann::json describe_environments(const PlaceGraph& graph);

}  // namespace placegraph::apps
