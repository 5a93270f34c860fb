#include <placegraph/eval/internal/trajectory/edge_consistency.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <nanobind/stl/map.h>

#include "python/src/bindings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// The consistency of the edges of each source.
std::map<std::string, EdgeConsistency> consistency_of(const PoseGraph& graph,
                                                      const std::map<std::int64_t, SE3>& truth) {
  require(graph.kind() == PoseKind::kSE3, "graph: edges over SE(3) are needed");
  std::map<NodeId, SE3> T_world_node;
  for (const auto& [node, pose] : truth) T_world_node.emplace(NodeId(node), pose);
  std::map<std::string, std::vector<RelativePoseConstraint>> by_source;
  for (const Constraint& constraint : graph.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      by_source[to_string(edge->source)].push_back(*edge);
  std::map<std::string, EdgeConsistency> result;
  for (const auto& [source, edges] : by_source)
    result.emplace(source, edge_consistency(edges, T_world_node));
  return result;
}

}  // namespace

void bind_edges(nb::module_& m) {
  nb::class_<EdgeConsistency>(m, "EdgeConsistency", doc("EdgeConsistency"))
      .def_ro("edges", &EdgeConsistency::edges, doc("EdgeConsistency::edges"))
      .def_ro("unknown", &EdgeConsistency::unknown, doc("EdgeConsistency::unknown"))
      .def_ro("mean_nees", &EdgeConsistency::mean_nees, doc("EdgeConsistency::mean_nees"))
      .def_ro("median_nees", &EdgeConsistency::median_nees, "The median of the same.")
      .def_ro("share_beyond_99", &EdgeConsistency::share_beyond_99,
              doc("EdgeConsistency::share_beyond_99"));
  m.def("edge_consistency", &consistency_of, "graph"_a, "truth"_a,
        nb::call_guard<nb::gil_scoped_release>(),
        "Errors of the edges of a pose graph over SE(3), relative to their covariances, for each "
        "source of edges ('odometry', 'loop' ...).\n\n`truth`: true poses T_world_node by the ids "
        "of the nodes. Nothing is fitted: only relative poses are compared.");
}

}  // namespace placegraph::python
