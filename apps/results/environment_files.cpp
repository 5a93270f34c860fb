#include "apps/results/environment_files.h"

#include <fmt/format.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph::apps {

std::string environment_csv(const std::vector<EnvironmentObservation>& observations) {
  CsvText csv;
  csv.add("frame");
  for (const char* name : evidence_names()) csv.add(name);
  for (int k = 0; k < kEnvironmentCount; ++k)
    csv.add(fmt::format("p_{}", environment_name(static_cast<Environment>(k))));
  csv.row("kind");
  for (const EnvironmentObservation& observation : observations) {
    csv.add(observation.frame);
    for (const double value : observation.evidence.values)
      csv.add(std::isfinite(value) ? fmt::format("{:.4g}", value) : "");
    for (const double p : observation.probabilities) csv.add(fmt::format("{:.3f}", p));
    csv.row(observation.kind ? environment_name(*observation.kind) : "unknown");
  }
  return csv.text();
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
