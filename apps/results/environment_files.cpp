#include "apps/results/environment_files.h"
#include <placegraph/pipeline/slam/environment_observation.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph::apps {

std::string environment_csv(const std::vector<EnvironmentObservation>& observations) {
  std::string csv = "frame";
  for (const char* name : evidence_names()) csv += fmt::format(",{}", name);
  for (int k = 0; k < kEnvironmentCount; ++k)
    csv += fmt::format(",p_{}", environment_name(static_cast<Environment>(k)));
  csv += ",kind\n";
  for (const EnvironmentObservation& observation : observations) {
    csv += to_string(observation.frame);
    for (const double value : observation.evidence.values)
      csv += std::isfinite(value) ? fmt::format(",{:.4g}", value) : ",";
    for (const double p : observation.probabilities) csv += fmt::format(",{:.3f}", p);
    csv += "," + (observation.kind ? environment_name(*observation.kind) : std::string("unknown")) +
           "\n";
  }
  return csv;
}

nlohmann::json describe_environments(const PlaceGraph& graph) {
  nlohmann::json counts;
  for (int k = 0; k < kEnvironmentCount; ++k)
    counts[environment_name(static_cast<Environment>(k))] = 0;
  counts["unknown"] = 0;
  for (const Place& place : graph.places) {
    const auto kind = environment_of(place);
    const std::string name = kind ? environment_name(*kind) : "unknown";
    counts[name] = counts[name].get<int>() + 1;
  }
  return counts;
}

}  // namespace placegraph::apps
