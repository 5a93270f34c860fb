#pragma once
#include <placegraph/graph/core/ids.h>

#include <string>
#include <vector>

#include "apps/graph/landmark_solution.h"

namespace placegraph::apps {

/// One line if another initialization may end at another solution of the same cost.
void warn_of_free_directions(const std::string& in, int count, const std::vector<NodeId>& vertices);

/// One line if components of a graph with priors or landmarks are not constrained to the world.
void warn_of_parts(const std::string& in, const LandmarkSolution& solution);

}  // namespace placegraph::apps
