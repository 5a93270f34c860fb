#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct MappedMarker {
  PlacedMarker marker;
  /// Right tangent of T_world_marker; zero if the marker was known.
  Matrix6d covariance = Matrix6d::Zero();
  int views = 0;
};

struct MarkerMap {
  /// Outcomes: too few data (no marker was seen often enough), those of the optimizer.
  Outcome outcome;
  std::vector<MappedMarker> markers;  ///< in the order of their ids
  PoseGraph graph;                    ///< frames by number, markers by marker_node
  /// The markers as a layout, for MarkerFilter.
  MarkerLayout layout(const std::string& dictionary) const;
};

/// The node of a marker in the graph.
NodeId marker_node(int id);

}  // namespace placegraph
