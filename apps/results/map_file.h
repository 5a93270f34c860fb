#pragma once
#include <placegraph/io/map/map_database.h>

#include <string>

namespace placegraph::apps {

/// The map.db in a folder written by `placegraph run`, or the file itself.
std::string map_path_of(const std::string& file_or_folder);

/// Reads a saved map; warns if its run was broken off.
StoredMap read_stored_map(const std::string& file_or_folder);

}  // namespace placegraph::apps
