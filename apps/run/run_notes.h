#pragma once
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What the reader says of the sequence, what its images show, and what is odd about the options.
std::vector<DataNote> notes_of(const Dataset& dataset, const RunOptions& options);

/// What the motion that was found says against its scale.
std::vector<DataNote> notes_of_motion(const RunResult& run, const Trajectory& optimized);

/// Adds them to what result.json says; lengths that are in doubt are not called metric.
void add_notes(const std::vector<DataNote>& notes, nlohmann::json& summary);

/// Frames without a pose by their reasons.
nlohmann::json describe_unposed(const RunResult& run);

/// ": 8 points, 12 needed (39 of 40 frames)"; of the most frequent reason.
std::string why_unposed(const RunResult& run);

}  // namespace placegraph::apps
