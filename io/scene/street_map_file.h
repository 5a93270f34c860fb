#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/scene/street_map.h>

#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// The known cells as a binary little-endian PLY: x y z [m, frame of the map], red green blue of
/// the class, label, confidence, height above the ground [m], weight, `sights` (number of
/// observations). Classes are comments (`comment class NUMBER NAME`), as are cell_m and R_plan_map.
std::string to_ply(const StreetMap& map);

/// Reads such a file, without log_odds and unknown cells. Throws FileError if the file is missing,
/// truncated, in another format, or has impossible values.
StreetMap read_street_map(const std::string& path);

/// The content of semantic_map.json: frame, size of the cells, for every class its colour, number
/// of cells and area seen from above [m^2]; for every place the shares of the classes seen from it.
std::string to_json(
    const StreetMap& map,
    const std::vector<std::pair<PlaceId, std::vector<float>>>& shares_by_place = {});

/// The top view of a map as GeoJSON (RFC 7946), for a map frame east, north, up about `origin`: a
/// MultiPolygon for every class, with properties class, area_m2 and colour. Patches smaller than
/// `min_area_m2` are left out. Throws ArgumentError for an invalid origin.
std::string to_geojson(const StreetMap& map, const GeodeticPosition& origin,
                       double min_area_m2 = 1);

}  // namespace placegraph
