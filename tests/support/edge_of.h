#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph::test {

/// The i-th constraint, which relates two poses.
inline const RelativePoseConstraint& edge_of(const PoseGraph& graph, std::size_t i) {
  return std::get<RelativePoseConstraint>(graph.constraints.at(i));
}

}  // namespace placegraph::test
