#pragma once
#include <placegraph/pipeline/run_notes.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names inertial measurements of a folder in EuRoC's layout, which a run does not use.
std::optional<DataNote> note_of_unused_imu(const std::string& sequence);

/// Adds the notes to result.json.
void add_notes(const std::vector<DataNote>& notes, nlohmann::json& summary);

/// Frames without a pose, by reason.
nlohmann::json describe_unposed(const RunResult& run);

/// Text such as ": 8 points, 12 needed (39 of 40 frames)", for the most frequent reason.
std::string why_unposed(const RunResult& run);

}  // namespace placegraph::apps
