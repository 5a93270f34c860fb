#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace placegraph::apps {

/// Result of `placegraph run`.
struct RunReport {
  std::string out;         ///< folder of the results
  nlohmann::json summary;  ///< content of result.json
  /// Error of the first unreadable frame; the results cover the frames before it.
  std::optional<std::string> broken_off;
  /// A signal ended the run: how to continue it. The results are those of the frames before it.
  std::optional<std::string> interrupted;
  std::optional<std::string> no_result;  ///< reason if no frame has a pose
};

/// Summary in a few lines.
std::string to_text(const RunReport& report);
/// Content of result.json.
std::string to_json(const RunReport& report);
/// Table of the CPU time of every stage.
std::string stages_text(const RunReport& report);

}  // namespace placegraph::apps
