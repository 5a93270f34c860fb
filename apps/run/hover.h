#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/run/flight.h"

namespace placegraph::apps {

struct HoverResult {
  std::string out;                       ///< the folder of the results
  nlohmann::json summary;                ///< what result.json in it says
  std::optional<std::string> no_answer;  ///< no image has a state, or no marker a place: why
};

/// `placegraph hover`: where a flying robot was; writes the results into their folder. Progress
/// goes to stderr. Throws ArgumentError, FileError.
HoverResult hover(const HoverArguments& arguments);

/// What was found in a few lines.
std::string to_text(const HoverResult& result);
/// result.json.
std::string to_json(const HoverResult& result);
/// The table of the processor's time in each stage.
std::string stages_text(const HoverResult& result);

}  // namespace placegraph::apps
