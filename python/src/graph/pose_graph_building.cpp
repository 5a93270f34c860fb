#include <fmt/format.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <filesystem>

#include "python/src/backend/graphs.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Strings = std::optional<std::vector<std::string>>;
using Ids = std::optional<std::vector<std::int64_t>>;

ConstraintSource source_of(const std::string& name) {
  const auto source = constraint_source(name);
  require(source.has_value(), "source: 'odometry', 'loop' or 'other', not '" + name + "'");
  return *source;
}

Information information_of(const double* first, int dof) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(first, dof, dof);
}

void append_nodes(const ArrayArgument<std::int64_t>& ids, const ArrayArgument<double>& poses,
                  PoseGraph& graph) {
  const auto numbers = ids.get("ids", {kAny});
  const auto rows = poses.get("poses", {kAny, kAny});
  const std::size_t width = rows.shape(1);
  require(width == 3 || width == 7 || width == 8,
          fmt::format("poses: rows of 3 (SE(2)), 7 (SE(3)) or 8 (Sim(3)) numbers, not {}", width));
  require(numbers.shape(0) == rows.shape(0),
          fmt::format("poses: {} ids and {} poses", numbers.shape(0), rows.shape(0)));
  for (std::size_t i = 0; i < rows.shape(0); ++i)
    graph.nodes.push_back(
        {NodeId(numbers.data()[i]),
         pose_of_row(rows.data() + i * width, width, fmt::format("poses: row {}", i)), false});
}

void append_edges(const ArrayArgument<std::int64_t>& edges, const ArrayArgument<double>& measured,
                  const ArrayArgument<double>& information, const Strings& sources,
                  PoseGraph& graph) {
  const auto pairs = edges.get("edges", {kAny, 2});
  const auto rows = measured.get("measurements", {static_cast<int>(pairs.shape(0)), kAny});
  const std::size_t width = rows.shape(1);
  require(graph.nodes.empty() || width == row_width(graph.kind()) || pairs.shape(0) == 0,
          fmt::format("measurements: rows of {} numbers, as the poses, are needed, not of {}",
                      row_width(graph.kind()), width));
  require(width == 3 || width == 7 || width == 8 || pairs.shape(0) == 0,
          fmt::format("measurements: rows of 3, 7 or 8 numbers are needed, not of {}", width));
  const int dof = width == 8 ? 7 : width == 7 ? 6 : 3;
  const auto matrices =
      pairs.shape(0) == 0
          ? information.get("information", {0, kAny, kAny})
          : information.get("information", {static_cast<int>(pairs.shape(0)), dof, dof});
  require(!sources || sources->size() == pairs.shape(0), "sources: one for each edge is needed");
  for (std::size_t i = 0; i < pairs.shape(0); ++i) {
    RelativePoseConstraint edge;
    edge.from = NodeId(pairs.data()[2 * i]);
    edge.to = NodeId(pairs.data()[2 * i + 1]);
    edge.T_from_to =
        pose_of_row(rows.data() + i * width, width, fmt::format("measurements: row {}", i));
    edge.information =
        information_of(matrices.data() + i * static_cast<std::size_t>(dof * dof), dof);
    edge.source = sources                                    ? source_of((*sources)[i])
                  : edge.to.value() == edge.from.value() + 1 ? ConstraintSource::kOdometry
                                                             : ConstraintSource::kLoop;
    graph.constraints.emplace_back(edge);
  }
}

void fix(PoseGraph& graph, const std::vector<std::int64_t>& ids) {
  const NodeIndex index = graph.index_by_id();
  for (const std::int64_t id : ids) {
    const auto at = index.find(NodeId(id));
    require(at.has_value(), fmt::format("fixed: there is no node {}", id));
    graph.nodes[static_cast<std::size_t>(*at)].fixed = true;
  }
}

PoseGraph from_arrays(const ArrayArgument<std::int64_t>& ids, const ArrayArgument<double>& poses,
                      const ArrayArgument<std::int64_t>& edges,
                      const ArrayArgument<double>& measurements,
                      const ArrayArgument<double>& information, const Strings& sources,
                      const Ids& fixed) {
  PoseGraph graph;
  append_nodes(ids, poses, graph);
  append_edges(edges, measurements, information, sources, graph);
  if (fixed) fix(graph, *fixed);
  graph.check();
  return graph;
}

/// The kind of the poses and measurements that a graph has; none if it is empty.
std::optional<PoseKind> kind_in(const PoseGraph& graph) {
  if (!graph.nodes.empty()) return graph.kind();
  for (const Constraint& constraint : graph.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      return kind_of(edge->T_from_to);
  return std::nullopt;
}

/// A pose of the kind that the graph has; throws ArgumentError, which names the argument.
Pose fitting_pose(const PoseGraph& graph, nb::handle value, const char* argument) {
  const Pose pose = pose_of(value, argument);
  const auto kind = kind_in(graph);
  require(!kind || *kind == kind_of(pose),
          fmt::format("{}: its kind is not that of the other poses", argument));
  return pose;
}

void add_edge(PoseGraph& graph, std::int64_t from, std::int64_t to, nb::handle measurement,
              const ArrayArgument<double>& information, const std::string& source,
              const RobustKernel& kernel) {
  RelativePoseConstraint edge;
  edge.from = NodeId(from);
  edge.to = NodeId(to);
  edge.T_from_to = fitting_pose(graph, measurement, "measurement");
  const int dof = degrees_of_freedom(kind_of(edge.T_from_to));
  edge.information = information_of(information.get("information", {dof, dof}).data(), dof);
  const char* fault = fault_of(edge.information);
  require(!fault, fault ? fault : "");
  edge.source = source_of(source);
  edge.kernel = kernel;
  graph.constraints.emplace_back(edge);
}

void add_position(PoseGraph& graph, std::int64_t node, const ArrayArgument<double>& position,
                  const ArrayArgument<double>& information,
                  const std::optional<ArrayArgument<double>>& lever_arm,
                  const RobustKernel& kernel) {
  PositionConstraint constraint;
  constraint.node = NodeId(node);
  constraint.position_world = Eigen::Vector3d(position.get("position", {3}).data());
  if (lever_arm) constraint.lever_arm = Eigen::Vector3d(lever_arm->get("lever_arm", {3}).data());
  constraint.information = Eigen::Matrix3d(information.get("information", {3, 3}).data());
  const char* fault = fault_of(constraint.information);
  require(!fault, fault ? fault : "");
  constraint.kernel = kernel;
  graph.constraints.emplace_back(constraint);
}

void set_poses(PoseGraph& graph, const ArrayArgument<double>& poses) {
  const std::size_t width = row_width(graph.kind());
  const auto rows =
      poses.get("poses", {static_cast<int>(graph.nodes.size()), static_cast<int>(width)});
  std::vector<Pose> checked;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    checked.push_back(pose_of_row(rows.data() + i * width, width, fmt::format("poses: row {}", i)));
  for (std::size_t i = 0; i < checked.size(); ++i) graph.nodes[i].T_world_node = checked[i];
}

PoseGraph without(const PoseGraph& graph, const std::vector<int>& constraints) {
  PoseGraph rest{graph.nodes, {}};
  std::vector<char> left_out(graph.constraints.size());
  for (const int i : constraints) {
    require(i >= 0 && static_cast<std::size_t>(i) < left_out.size(),
            fmt::format("constraints: there is no constraint {}", i));
    left_out[static_cast<std::size_t>(i)] = true;
  }
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (!left_out[i]) rest.constraints.push_back(graph.constraints[i]);
  return rest;
}

/// Reads a file without the GIL; what was passed over becomes a warning of Python.
PoseGraph read(const std::filesystem::path& file) {
  const std::string path = file.string();
  std::vector<std::string> remarks;
  PoseGraph graph;
  {
    const nb::gil_scoped_release release;
    graph = read_pose_graph(path, {.connected = false, .remarks = &remarks});
  }
  for (const std::string& remark : remarks)
    if (PyErr_WarnEx(PyExc_UserWarning, (path + ": " + remark).c_str(), 1) != 0)
      throw nb::python_error();
  return graph;
}

}  // namespace

void bind_pose_graph_building(nb::class_<PoseGraph>& graph) {
  graph.def(nb::init<>(), "An empty graph.")
      .def_static(
          "from_arrays", &from_arrays, "ids"_a, "poses"_a, "edges"_a, "measurements"_a,
          "information"_a, "sources"_a = nb::none(), "fixed"_a = nb::none(),
          "A graph of N ids and poses, and M edges (from, to) with measured poses T_from_to "
          "and information (M x D x D, in the right tangent: translation, rotation, log "
          "scale). Without sources, edges between consecutive ids are odometry, others "
          "loops; the nodes `fixed` keep their poses.")
      .def_static("read", &read, "path"_a, doc("read_pose_graph"))
      .def(
          "write_g2o",
          [](const PoseGraph& g, const std::filesystem::path& path) {
            const PoseGraph copy = g;
            const nb::gil_scoped_release release;
            write_g2o(path.string(), copy);
          },
          "path"_a, doc("write_g2o"))
      .def(
          "add_node",
          [](PoseGraph& g, std::int64_t id, nb::object pose, bool fixed) {
            g.nodes.push_back({NodeId(id), fitting_pose(g, pose, "pose"), fixed});
          },
          "id"_a, "pose"_a, "fixed"_a = false,
          "Adds a node; `pose` is an SE2, SE3 or Sim3, or a row. See check().")
      .def("add_edge", &add_edge, "from_"_a, "to"_a, "measurement"_a, "information"_a,
           "source"_a = "odometry", "kernel"_a = RobustKernel(),
           "Adds a measured pose T_from_to of node `to` relative to node `from_`, with its "
           "information (D x D). See check().")
      .def("add_position", &add_position, "node"_a, "position"_a, "information"_a,
           "lever_arm"_a = nb::none(), "kernel"_a = RobustKernel(),
           "Adds the measured position [m] of a point that a node carries, such as an antenna.\n\n"
           "error = T_world_node * lever_arm - position, with its information (3 x 3). Without a "
           "lever arm the point is the node's origin. In the plane the third components are "
           "ignored. See check().")
      .def("set_poses", &set_poses, "poses"_a, "Replaces all poses by rows as those of `poses`.")
      .def(
          "integrate_odometry",
          [](PoseGraph& g) {
            PoseGraph copy = g;
            integrate_odometry(copy);
            g = std::move(copy);
          },
          doc("integrate_odometry"))
      .def("without", &without, "constraints"_a,
           "A copy without constraints, given by their positions among all constraints.")
      .def(
          "copy", [](const PoseGraph& g) { return g; }, "A graph with the same content.")
      .def("__copy__", [](const PoseGraph& g) { return g; })
      .def("__deepcopy__", [](const PoseGraph& g, nb::handle) { return g; });
}

}  // namespace placegraph::python
