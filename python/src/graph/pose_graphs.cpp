#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>

#include "python/src/backend/graphs.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// The constraints of one kind with their positions among all.
template <class Kind>
std::vector<std::pair<int, const Kind*>> constraints_of(const PoseGraph& graph) {
  std::vector<std::pair<int, const Kind*>> found;
  for (std::size_t i = 0; i < graph.constraints.size(); ++i)
    if (const auto* constraint = std::get_if<Kind>(&graph.constraints[i]))
      found.emplace_back(static_cast<int>(i), constraint);
  return found;
}

/// An array with one row of values for each constraint of a kind, which `append` appends.
template <class Kind, class T, class Append>
ReadOnlyArray<T> table_of(const PoseGraph& graph, std::vector<std::size_t> shape,
                          const Append& append) {
  std::vector<T> values;
  std::size_t count = 0;
  for (const auto& [number, constraint] : constraints_of<Kind>(graph)) {
    append(number, *constraint, values);
    ++count;
  }
  shape.insert(shape.begin(), count);
  return owned_array(std::move(values), std::move(shape));
}

using Edge = RelativePoseConstraint;
using Numbers = ReadOnlyArray<double>;
using Integers = ReadOnlyArray<std::int64_t>;

Integers ids_of(const PoseGraph& graph) {
  std::vector<std::int64_t> ids;
  for (const PoseNode& node : graph.nodes) ids.push_back(node.id.value());
  const std::size_t count = ids.size();
  return owned_array(std::move(ids), {count});
}

Integers fixed_of(const PoseGraph& graph) {
  std::vector<std::int64_t> ids;
  for (const PoseNode& node : graph.nodes)
    if (node.fixed) ids.push_back(node.id.value());
  const std::size_t count = ids.size();
  return owned_array(std::move(ids), {count});
}

Numbers poses_of(const PoseGraph& graph) {
  std::vector<double> values;
  for (const PoseNode& node : graph.nodes) append_row(node.T_world_node, values);
  return owned_array(std::move(values), {graph.nodes.size(), row_width(graph.kind())});
}

nb::any pose_of_id(const PoseGraph& graph, std::int64_t id) {
  const auto at = graph.index_by_id().find(NodeId(id));
  require(at.has_value(), fmt::format("id: there is no node {}", id));
  return std::visit([](const auto& pose) { return as_any(nb::cast(pose)); },
                    graph.nodes[static_cast<std::size_t>(*at)].T_world_node);
}

std::vector<std::string> sources_of(const PoseGraph& graph) {
  std::vector<std::string> sources;
  for (const auto& [number, edge] : constraints_of<Edge>(graph))
    sources.emplace_back(to_string(edge->source));
  return sources;
}

std::vector<RobustKernel> kernels_of(const PoseGraph& graph) {
  std::vector<RobustKernel> kernels;
  for (const Constraint& constraint : graph.constraints)
    kernels.push_back(std::visit([](const auto& c) { return c.kernel; }, constraint));
  return kernels;
}

const char* kind_name(const PoseGraph& graph) {
  const char* const names[] = {"SE2", "SE3", "Sim3"};
  return names[static_cast<int>(graph.kind())];
}

std::string text_of(const PoseGraph& graph) {
  return fmt::format("<PoseGraph over {}: {} nodes, {} constraints>", kind_name(graph),
                     graph.nodes.size(), graph.constraints.size());
}

void bind_nodes_and_edges(nb::class_<PoseGraph>& graph) {
  graph.def_prop_ro("kind", &kind_name, "The group of the poses: 'SE2', 'SE3' or 'Sim3'.")
      .def_prop_ro("ids", &ids_of, kNew,
                   "Ids of the nodes, N of int64 (a copy, as all arrays here).")
      .def_prop_ro("poses", &poses_of, kNew,
                   "Poses T_world_node, one row each; `set_poses` replaces them.")
      .def("pose", &pose_of_id, "id"_a, "The pose of a node as an SE2, SE3 or Sim3.")
      .def_prop_ro("fixed", &fixed_of, kNew,
                   "Ids of the nodes that optimization leaves as they are.")
      .def_prop_ro(
          "edges",
          [](const PoseGraph& g) {
            return table_of<Edge, std::int64_t>(g, {2}, [](int, const Edge& e, auto& values) {
              values.insert(values.end(), {e.from.value(), e.to.value()});
            });
          },
          kNew, "Ids of the two nodes of each relative pose, M x 2.")
      .def_prop_ro(
          "edge_constraints",
          [](const PoseGraph& g) {
            return table_of<Edge, std::int64_t>(
                g, {}, [](int number, const Edge&, auto& values) { values.push_back(number); });
          },
          kNew, "Positions of the relative poses among all constraints, M.")
      .def_prop_ro(
          "measurements",
          [](const PoseGraph& g) {
            return table_of<Edge, double>(
                g, {row_width(g.kind())},
                [](int, const Edge& e, auto& values) { append_row(e.T_from_to, values); });
          },
          kNew, "Measured poses T_from_to, one row each; `from_arrays` makes a graph with others.")
      .def_prop_ro(
          "information",
          [](const PoseGraph& g) {
            const auto dof = static_cast<std::size_t>(degrees_of_freedom(g.kind()));
            return table_of<Edge, double>(g, {dof, dof}, [](int, const Edge& e, auto& values) {
              append_rows(e.information, values);
            });
          },
          kNew,
          "Information of each measured pose, M x D x D; `from_arrays` makes a graph with others.")
      .def_prop_ro("sources", as_tuple(&sources_of),
                   "Source of each measured pose: 'odometry', 'loop' or 'other'.");
}

void bind_positions(nb::class_<PoseGraph>& graph) {
  using Position = PositionConstraint;
  const auto vectors = [](const PoseGraph& g, Eigen::Vector3d Position::*member) {
    return table_of<Position, double>(g, {3}, [&](int, const Position& p, auto& values) {
      append_rows((p.*member).transpose(), values);
    });
  };
  graph
      .def_prop_ro(
          "position_nodes",
          [](const PoseGraph& g) {
            return table_of<Position, std::int64_t>(
                g, {},
                [](int, const Position& p, auto& values) { values.push_back(p.node.value()); });
          },
          kNew, "Ids of the nodes with measured positions, P.")
      .def_prop_ro(
          "positions", [=](const PoseGraph& g) { return vectors(g, &Position::position_world); },
          kNew, "Measured positions [m], P x 3.")
      .def_prop_ro(
          "lever_arms", [=](const PoseGraph& g) { return vectors(g, &Position::lever_arm); }, kNew,
          "Positions of the measured points in the frames of their nodes [m], P x 3.")
      .def_prop_ro(
          "position_information",
          [](const PoseGraph& g) {
            return table_of<Position, double>(g, {3, 3}, [](int, const Position& p, auto& values) {
              append_rows(p.information, values);
            });
          },
          kNew, "Information of the measured positions [1/m^2], P x 3 x 3.");
}

}  // namespace

void bind_pose_graphs(nb::module_& m) {
  nb::class_<RobustKernel> kernel(m, "RobustKernel", doc("RobustKernel"));
  bind_value(kernel, Hash::kByValue);
  kernel
      .def(
          "__init__",
          [](RobustKernel* self, const std::string& kind, double width) {
            const auto& names = robust_kernel_names();
            const auto found = std::find(names.begin(), names.end(), kind);
            require(found != names.end(), fmt::format("kind: one of {} is needed, not '{}'",
                                                      fmt::join(names, ", "), kind));
            require(std::isfinite(width) && width > 0, "width: it must be positive");
            new (self) RobustKernel{static_cast<RobustKernel::Kind>(found - names.begin()), width};
          },
          "kind"_a = "none", "width"_a = 1.0)
      .def_prop_ro(
          "kind",
          [](const RobustKernel& k) {
            return robust_kernel_names()[static_cast<std::size_t>(k.kind)];
          },
          "Name of the function rho.")
      .def_ro("width", &RobustKernel::width, doc("RobustKernel::width"))
      .def(
          "rho", [](const RobustKernel& k, double s) { return k.evaluate(s).rho; }, "s"_a,
          "rho(s) of a squared error.")
      .def("__repr__", [](const RobustKernel& k) {
        return fmt::format("RobustKernel('{}', {:g})",
                           robust_kernel_names()[static_cast<std::size_t>(k.kind)], k.width);
      });
  nb::class_<PoseGraph> graph(
      m, "PoseGraph",
      "Poses and constraints on them, over SE(2), SE(3) or Sim(3).\n\n"
      "Rows of poses: x y angle, x y z qx qy qz qw, or these and the scale.");
  bind_value(graph, Hash::kNone);
  bind_pose_graph_building(graph);
  bind_nodes_and_edges(graph);
  bind_positions(graph);
  graph
      .def_prop_ro("kernels", as_tuple(&kernels_of),
                   "Robust kernel of each constraint; `add_edge` takes one.")
      .def_prop_ro(
          "constraints", [](const PoseGraph& g) { return g.constraints.size(); },
          "Number of constraints of all kinds.")
      .def(
          "chi2",
          [](const PoseGraph& g, const std::string& rotation_error) {
            return chi2(g, rotation_error_of(rotation_error));
          },
          "rotation_error"_a = "log",
          "Sum of e^T Omega e over all constraints, without kernels. `rotation_error`: 'log' or "
          "'quaternion'. Raises ArgumentError as check().")
      .def("components", &PoseGraph::components, doc("PoseGraph::components"))
      .def("check", &PoseGraph::check, doc("PoseGraph::check"))
      .def("__len__", [](const PoseGraph& g) { return g.nodes.size(); })
      .def("__repr__", &text_of);
}

}  // namespace placegraph::python
