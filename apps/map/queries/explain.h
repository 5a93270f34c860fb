#pragma once
#include <placegraph/graph/core/ids.h>

#include <nlohmann/json.hpp>
#include <string>

namespace placegraph::apps {

struct ExplainArguments {
  std::string map;  ///< map.db, or a folder written by `placegraph run`
  FrameId frame;    ///< number of the frame in its sequence
};

struct ExplainResult {
  /// Members frame, stamp_s, where, known_by, sees, assumed, refused.
  nlohmann::json explanation;
};

/// Explains one frame: its pose, the evidence, the scene, rejected loops (`map explain`).
/// Throws ArgumentError, FileError, and NoResult if the map has no such frame.
ExplainResult explain(const ExplainArguments& arguments);

std::string to_text(const ExplainResult& result);
std::string to_json(const ExplainResult& result);

}  // namespace placegraph::apps
