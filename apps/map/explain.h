#pragma once
#include <placegraph/graph/core/ids.h>

#include <nlohmann/json.hpp>
#include <string>

namespace placegraph::apps {

struct ExplainArguments {
  std::string map;  ///< map.db, or the folder of placegraph run with it
  FrameId frame;    ///< its number in the sequence
};

struct ExplainResult {
  /// frame, stamp_s, where, known_by, sees, assumed, refused: what the map knows of each.
  nlohmann::json told;
};

/// `placegraph explain`: where one frame of a map is, how that is known, what it sees and what was
/// refused. Throws ArgumentError, FileError, and NoAnswer where the map has no such frame.
ExplainResult explain(const ExplainArguments& arguments);

std::string to_text(const ExplainResult& result);
std::string to_json(const ExplainResult& result);

}  // namespace placegraph::apps
