#pragma once
#include <placegraph/io/map/stored_map.h>

#include "python/src/arrays.h"

namespace placegraph::python {

// Tables of a map: dictionaries of arrays, one entry for each row.
Table frame_table(const Map& map);
Table keyframe_table(const Map& map);
Table landmark_table(const Map& map);
Table observation_table(const Map& map);
Table loop_table(const Map& map);
Table feature_table(const Map& map, std::int64_t keyframe);

// Parts of a map that vary in their members: a dictionary each.
TableList place_rows(const Map& map);
TableList edge_rows(const Map& map);
TableList component_rows(const Map& map);

/// A part of bind_maps.
void bind_explanation(nb::module_& m);

}  // namespace placegraph::python
