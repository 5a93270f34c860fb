#pragma once
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// File form of a map or of a part of it.
struct MapExportForm {
  std::string flag;  ///< flag of the command line
  std::string what;  ///< description of the content
};

/// All forms.
std::vector<MapExportForm> map_export_forms();

struct MapExportArguments {
  std::string map;  ///< map.db, or a folder written by `placegraph run`
  std::vector<std::string>
      paths;  ///< one path per form, in the order of map_export_forms(); empty: none
  /// Component whose trajectory is written; nothing: the main one.
  std::optional<int> component;
  bool force = false;  ///< overwrite existing files
};

struct MapExportResult {
  std::vector<std::string> written;  ///< paths of the written files
};

/// Writes parts of a saved map as separate files: `placegraph map export`.
/// Warns on stderr of a map whose run was broken off. Throws ArgumentError if nothing is to be
/// written or a file exists, FileError, and NoResult if a form needs poses and the map has none.
MapExportResult map_export(const MapExportArguments& arguments);

}  // namespace placegraph::apps
