#pragma once
#include <string>
#include <vector>

namespace placegraph::apps {

/// A form that a map, or a part of it, is written in.
struct MapExportForm {
  std::string flag;  ///< of the command line
  std::string what;  ///< is written
};

/// All forms there are.
std::vector<MapExportForm> map_export_forms();

struct MapExportArguments {
  std::string map;                 ///< map.db, or the folder of placegraph run with it
  std::vector<std::string> paths;  ///< one a form, in the order of map_export_forms(); empty: none
  bool force = false;              ///< overwrite files
};

struct MapExportResult {
  std::vector<std::string> written;  ///< files
};

/// `placegraph map export`: writes parts of a saved map as files of their own. Warns on stderr of a
/// map whose run was broken off. Throws ArgumentError where nothing is to be written or a file is
/// there already, FileError, and NoAnswer where a form needs poses and the map has none.
MapExportResult map_export(const MapExportArguments& arguments);

}  // namespace placegraph::apps
