#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/map/map_options.h>
#include <placegraph/pipeline/run_options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The map.db in a folder written by `placegraph run`, or the file itself.
std::string map_path_of(const std::string& file_or_folder);

/// Reads a saved map; warns if its run was broken off. Throws as read_map.
StoredMap read_stored_map(const std::string& file_or_folder, const LogSink& log_sink = {});

/// The options of the run that made a map; the defaults for a map of no run.
///
/// `path` is the map's file, for messages. Throws FileError for options that this program does not
/// know.
RunOptions options_of_run(const std::string& path, const MapOrigin& origin);

/// Options with which images are localized in a map.
///
/// Views are compared by the cues of their descriptions, features as in the run. Throws as
/// options_of_run, and NoResult if the map has no views of its keyframes.
LocalizerOptions localizer_options_of(const std::string& path, const MapOrigin& origin);

}  // namespace placegraph
