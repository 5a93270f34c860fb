#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>

#include <map>
#include <string>

namespace placegraph::apps {

/// What a folder of `placegraph run` tells of its places (graph.g2o and places.json), or a saved
/// map (map.db).
struct RunMap {
  PlaceGraph graph;  ///< without appearances
  std::map<KeyframeId, FrameId> frame_of_keyframe;

  /// The frame that a place's anchor was seen in. Throws ArgumentError for a place without.
  FrameId anchor_frame(const Place& place) const;
};

/// Throws FileError where a file is missing or not what `placegraph run` writes, ArgumentError for
/// a map without poses.
RunMap read_run_map(const std::string& folder);

}  // namespace placegraph::apps
