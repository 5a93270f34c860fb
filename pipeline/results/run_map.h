#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Unit of the lengths of a map in texts and plots: "m", or "units" if its scale is unknown.
const char* unit_of(bool metric);

/// Places of a folder of `placegraph run` (graph.g2o and places.json) or of a map.db.
struct RunMap {
  PlaceGraph graph;                                 ///< without appearances
  bool metric = false;                              ///< lengths are in metres
  std::optional<std::size_t> frames;                ///< frames of the run, if its folder says
  std::map<KeyframeId, FrameId> frame_of_keyframe;  ///< frames of the keyframes of its places
  std::string file;                                 ///< file that lists the places

  /// Frame of a place's anchor keyframe. Throws FileError for a place without one.
  FrameId anchor_frame(const Place& place) const;
  /// Unit of its lengths in texts and plots: "m", or "units" if the scale is unknown.
  const char* unit() const { return unit_of(metric); }
};

/// Whether lengths are metres, by result.json in the folder of a run. Throws FileError.
bool metric_of_run(const std::string& folder);

/// Reads the places of a folder or of a saved map.
/// Throws FileError if a file is missing or not written by `placegraph run`, ArgumentError for a
/// map without poses.
RunMap read_run_map(const std::string& folder);

}  // namespace placegraph
