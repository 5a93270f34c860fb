#pragma once
#include <cstddef>
#include <string>

namespace placegraph::apps {

struct MapValidateArguments {
  std::string map;  ///< map.db, or a folder written by `placegraph run`
};

struct MapValidateResult {
  std::string map;  ///< path of the file
  bool finished = false;
  std::size_t places = 0, frames = 0;
};

/// Checks a saved map: `placegraph map validate`.
/// In addition to the checks of reading (every row, reference and number), it checks the structure
/// of the file, the referenced frames, and whether a run can continue from it. Throws FileError
/// with file, table, row and error.
MapValidateResult map_validate(const MapValidateArguments& arguments);

/// One line.
std::string to_text(const MapValidateResult& result);
std::string to_json(const MapValidateResult& result);

}  // namespace placegraph::apps
