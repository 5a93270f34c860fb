#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/run/flight.h"

namespace placegraph::apps {

struct FlightResult {
  std::string out;                       ///< the folder of the results
  nlohmann::json summary;                ///< what result.json in it says
  std::optional<std::string> no_answer;  ///< no image has a state, or no marker a place: why
};

/// `placegraph flight run`: estimates the states of a flying robot and writes the results into their folder. Progress
/// goes to stderr. Throws ArgumentError, FileError.
FlightResult fly(const FlightArguments& arguments);

/// What was found in a few lines.
std::string to_text(const FlightResult& result);
/// result.json.
std::string to_json(const FlightResult& result);
/// The table of the processor's time in each stage.
std::string stages_text(const FlightResult& result);

}  // namespace placegraph::apps
