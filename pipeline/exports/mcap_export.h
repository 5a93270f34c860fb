#pragma once
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace placegraph {

/// A component of a map as messages of Foxglove's types, in MCAP.
///
/// /tf: the camera of every posed frame in `map`, and `map` (y down) in `world` (x forward, z up);
/// /trajectory and /landmarks: all poses and points, at the time of the first frame.
/// Throws ArgumentError if a stamp is negative, NoResult if no frame has a pose.
std::string map_mcap(const StoredMap& stored, int component);

}  // namespace placegraph
