#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/stored_map.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::report {

/// What a page shows: `runs` as describe_run_for_report() gives them.
nlohmann::json report_data(const std::string& title, const std::string& program,
                           nlohmann::json runs);

/// A run as a member of the report: a folder that `placegraph run` wrote, or its map.db.
///
/// Where the recording is at its path and has ground truth, errors and figures are those of the
/// optimized trajectory against it. Floor plan, street map and georeference are those in its
/// folder; `georeference`, if not empty, is another folder of `placegraph map georeference`.
/// `log` takes warnings of what is left out. Throws FileError as read_map, and for files beside the
/// map that are broken.
nlohmann::json describe_run_for_report(const std::string& file_or_folder,
                                       const std::string& georeference = "",
                                       const LogSink& log = {});
/// The same for a map that was read; `path`: its file, beside which are the other results.
nlohmann::json describe_run_for_report(const StoredMap& stored, const std::string& path,
                                       const std::string& georeference = "",
                                       const LogSink& log = {});

}  // namespace placegraph::report
