#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/route.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// Members of the places in the folder of a run, each once.
/// They are the stamp of a keyframe [ns], and its place. Throws FileError.
std::vector<std::pair<std::int64_t, PlaceId>> read_visits(const std::string& folder);

/// Reads the places of a folder or of a saved map.
/// Throws FileError if a file is missing or not written by `placegraph run`, ArgumentError for a
/// map without poses.
RunMap read_run_map(const std::string& folder);

/// A route over the places of a map, and the loops of the map; SVG.
std::string route_picture(const Route& route, const RunMap& map);

}  // namespace placegraph
