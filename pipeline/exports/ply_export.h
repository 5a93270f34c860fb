#pragma once
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace placegraph {

/// The landmarks of a component of a map as PLY: position, colour (grey if unknown) and the
/// standard deviation in the worst direction (nan if unknown), in the map frame.
std::string landmarks_ply(const StoredMap& stored, int component, NumberForm form);

}  // namespace placegraph
