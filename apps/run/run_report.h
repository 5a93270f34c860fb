#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace placegraph::apps {

/// What `placegraph run` found.
struct RunReport {
  std::string out;         ///< the folder of the results
  nlohmann::json summary;  ///< what result.json in it says
  /// A frame could not be read: its error. The results are those of the frames before it.
  std::optional<std::string> broken_off;
  /// A signal ended the run: how to continue it. The results are those of the frames before it.
  std::optional<std::string> interrupted;
  std::optional<std::string> no_answer;  ///< no frame could be posed: why
};

/// What was found in a few lines.
std::string to_text(const RunReport& report);
/// result.json.
std::string to_json(const RunReport& report);
/// The table of the processor's time in each stage.
std::string stages_text(const RunReport& report);

}  // namespace placegraph::apps
