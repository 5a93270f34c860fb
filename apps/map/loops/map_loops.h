#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/map/loop_editor.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::apps {

/// An edit of a loop of a saved map.
enum class LoopEdit { kRefuse, kAccept, kAdd };

struct MapLoopsArguments {
  std::string map;                 ///< folder of a run, or its map
  LoopEdit edit = LoopEdit::kAdd;  ///< what is done with all pairs
  std::vector<std::string> pairs;  ///< "QUERY:MATCH", ids of frames
  std::string out;                 ///< file of the edited map
  bool keep_poses = false;         ///< the map is not optimized again
  bool force = false;              ///< overwrite an existing file
};

struct MapLoopsResult {
  std::string out;
  std::vector<std::string> edits;   ///< what was done, in sentences
  std::size_t loops = 0;            ///< accepted loops of the edited map
  std::optional<MapMotion> motion;  ///< how far the optimization moved the map
};

/// Edits loops of a saved map and writes it as a new one: `placegraph map loops`.
///
/// Throws ArgumentError for a pair that is no pair of frames, or whose edit cannot be made.
MapLoopsResult map_loops(const MapLoopsArguments& arguments);

std::string to_text(const MapLoopsResult& result);
/// JSON, a line a member.
std::string to_json(const MapLoopsResult& result);

}  // namespace placegraph::apps
