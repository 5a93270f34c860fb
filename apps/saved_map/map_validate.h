#pragma once
#include <cstddef>
#include <string>

namespace placegraph::apps {

struct MapValidateArguments {
  std::string map;  ///< map.db, or the folder of placegraph run with it
};

struct MapValidateResult {
  std::string map;  ///< the file
  bool finished = false;
  std::size_t places = 0, frames = 0;
};

/// `placegraph map validate`: whether a saved map is whole. Beside what reading checks (every row,
/// reference and number) these are the file's own structure, frames that others name, and whether a
/// run could go on from it. Throws FileError with what is wrong, by file, table and row.
MapValidateResult map_validate(const MapValidateArguments& arguments);

/// One line.
std::string to_text(const MapValidateResult& result);
std::string to_json(const MapValidateResult& result);

}  // namespace placegraph::apps
