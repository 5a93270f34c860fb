#pragma once
#include <placegraph/graph/scene/street_map.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph::report {

/// semantic_map.ply in the folder of a run; nothing where there is none, or where
/// semantic_map.geojson beside it says that its axes are those of the earth, not of the map.
/// Throws FileError.
std::optional<StreetMap> street_map_in(const std::string& folder);

/// The top view of a street map as an image, a pixel for each column of cells, and the ground
/// below it as a lattice of points in the map, one for every kStreetTile pixels; null if nothing is
/// known.
nlohmann::json describe_street_map(const StreetMap& map);

/// Columns of cells along the side of a square of the lattice.
inline constexpr int kStreetTile = 16;

}  // namespace placegraph::report
