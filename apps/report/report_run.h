#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// A run as a member of the report: a folder that `placegraph run` wrote, or its map.db.
///
/// Where the recording is at its path and has ground truth, errors and figures are those of the
/// optimized trajectory against it. Throws FileError as read_map.
nlohmann::json describe_run_for_report(const std::string& file_or_folder);

}  // namespace placegraph::apps
