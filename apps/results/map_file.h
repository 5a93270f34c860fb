#pragma once
#include <placegraph/io/map/map_database.h>

#include <string>

namespace placegraph::apps {

/// The map.db of a folder that `placegraph run` has written, or the file itself.
std::string map_path_of(const std::string& file_or_folder);

/// Reads it; warns of a map whose run was broken off.
StoredMap read_stored_map(const std::string& file_or_folder);

}  // namespace placegraph::apps
