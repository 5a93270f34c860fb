#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/flight/flight.h"

namespace placegraph::apps {

struct FlightResult {
  std::string out;                       ///< folder of the results
  nlohmann::json summary;                ///< content of result.json
  std::optional<std::string> no_result;  ///< reason if no image has a state or no marker a pose
};

/// Estimates the states of a flying robot and writes the results: `placegraph flight run`.
/// Progress goes to stderr. Throws ArgumentError, FileError.
FlightResult fly(const FlightArguments& arguments);

/// Summary in a few lines.
std::string to_text(const FlightResult& result);
/// Content of result.json.
std::string to_json(const FlightResult& result);
/// Table of the CPU time of every stage.
std::string stages_text(const FlightResult& result);

}  // namespace placegraph::apps
