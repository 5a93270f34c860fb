#include "apps/run/run_notes.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph::apps {

using nlohmann::json;

std::optional<DataNote> note_of_unused_imu(const std::string& sequence) {
  for (const char* file : {"mav0/imu0/data.csv", "imu0/data.csv"})
    if (std::filesystem::exists(std::filesystem::path(sequence) / file))
      return DataNote{"the inertial measurements of imu0 are not used (`flight run` uses them)"};
  return std::nullopt;
}

void add_notes(const std::vector<DataNote>& notes, json& summary) {
  summary["notes"] = json::array();
  for (const DataNote& note : notes) summary["notes"].push_back(note.text);
}

json describe_unposed(const RunResult& run) {
  json unposed = json::array();
  for (const UnposedFrames& frames : run.unposed)
    unposed.push_back({{"reason", frames.reason}, {"frames", frames.count}});
  return unposed;
}

std::string why_unposed(const RunResult& run) {
  if (run.unposed.empty()) return "";
  return ": " + run.unposed.front().reason + " (" + std::to_string(run.unposed.front().count) +
         " of " + std::to_string(run.map.frames.size()) +
         (run.map.frames.size() == 1 ? " frame)" : " frames)");
}

}  // namespace placegraph::apps
