#pragma once
#include <placegraph/graph/map.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Places with their members, edges, transitions and accepted loops of a map, as JSON.
std::string places_json(const Map& map);

/// All loops that were considered, CSV.
/// The columns are query,match,inliers,accepted,stage,model,lines,likeness, probability.
std::string loops_csv(const Map& map);

}  // namespace placegraph
