#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// A run as a member of the report: a folder that `placegraph run` wrote, or its map.db.
///
/// Where the recording is at its path and has ground truth, errors and figures are those of the
/// optimized trajectory against it. Floor plan, street map and georeference are those in its
/// folder; `georeference`, if not empty, is another folder of `placegraph map georeference`.
/// Throws FileError as read_map, and for files beside the map that are broken.
nlohmann::json describe_run_for_report(const std::string& file_or_folder,
                                       const std::string& georeference = "");

}  // namespace placegraph::apps
