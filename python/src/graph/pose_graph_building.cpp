#include <fmt/format.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <filesystem>

#include "python/src/backend/graphs.h"
#include "python/src/frontend/functions.h"
#include "python/src/warnings.h"

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
  const std::vector<Pose> given = poses_of(poses, "poses", kAny);
  require(numbers.shape(0) == given.size(),
          fmt::format("poses: {} ids and {} poses", numbers.shape(0), given.size()));
  for (std::size_t i = 0; i < given.size(); ++i)
    graph.nodes.push_back({NodeId(numbers.data()[i]), given[i], false});
}

void append_edges(const ArrayArgument<std::int64_t>& edges, const ArrayArgument<double>& measured,
                  const ArrayArgument<double>& information, const Strings& sources,
                  PoseGraph& graph) {
  const auto pairs = edges.get("edges", {kAny, 2});
  const auto count = static_cast<int>(pairs.shape(0));
  const std::vector<Pose> measurements = poses_of(measured, "measurements", count);
  require(!sources || sources->size() == pairs.shape(0), "sources: one for each edge is needed");
  if (count == 0) {
    information.get("information", {0, kAny, kAny});
    return;
  }
  const PoseKind kind = kind_of(measurements.front());
  require(graph.nodes.empty() || kind == graph.kind(),
          fmt::format("measurements: rows of {} numbers, as the poses, are needed, not of {}",
                      row_width(graph.kind()), row_width(kind)));
  const int dof = degrees_of_freedom(kind);
  const bool one_for_all = shape_of(information.value).size() == 2;
  const auto matrices = information.get(
      "information", one_for_all ? std::vector<int>{dof, dof} : std::vector<int>{count, dof, dof},
      Values::kFinite, fmt::format("{0} x {1} x {1}, or one for all, {1} x {1}", count, dof));
  const std::size_t step = one_for_all ? 0 : static_cast<std::size_t>(dof * dof);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    RelativePoseConstraint edge;
    edge.from = NodeId(pairs.data()[2 * i]);
    edge.to = NodeId(pairs.data()[2 * i + 1]);
    edge.T_from_to = measurements[i];
    edge.information = information_of(matrices.data() + i * step, dof);
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
  const std::vector<Pose> checked = poses_of(poses, "poses", static_cast<int>(graph.nodes.size()));
  require(checked.empty() || kind_of(checked.front()) == graph.kind(),
          fmt::format("poses: rows of {} numbers, as those of the graph, are needed, not of {}",
                      row_width(graph.kind()), row_width(kind_of(checked.front()))));
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
PoseGraph read(const std::filesystem::path& file, const std::string& indefinite) {
  const auto how =
      choice_of<IndefiniteInformation>(indefinite, indefinite_information_names(), "indefinite");
  const std::string path = file.string();
  std::vector<std::string> remarks;
  PoseGraph graph;
  {
    const WithoutGil released;
    graph = read_pose_graph(path, {.connected = false, .remarks = &remarks, .indefinite = how});
  }
  for (const std::string& remark : remarks) warn(path + ": " + remark);
  return graph;
}

}  // namespace

void bind_pose_graph_building(nb::class_<PoseGraph>& graph) {
  graph.def(nb::init<>(), "An empty graph.")
      .def_static(
          "from_arrays", &from_arrays, "ids"_a, "poses"_a, "edges"_a, "measurements"_a,
          "information"_a, "sources"_a = nb::none(), "fixed"_a = nb::none(),
          "A graph of N nodes and M edges with measured poses T_from_to.\n\n"
          "`ids`: N integers. `poses`: N rows (x y angle, x y z qx qy qz qw, or these and the "
          "scale) or N matrices (3 x 3 in the plane, 4 x 4 in space). `edges`: M x 2, from and to. "
          "`measurements`: M rows or matrices, as the poses. `information`: M x D x D, or D x D "
          "for "
          "all edges, in the right tangent: translation, rotation, log scale. Without `sources`, "
          "edges between consecutive ids are odometry, others loops. The nodes `fixed` keep their "
          "poses. Raises ArgumentError as check(), and for values that are not finite.")
      .def_static(
          "read", &read, "path"_a, "indefinite"_a = "refuse",
          "Reads a pose graph in the g2o, TORO or iSAM format.\n\n`indefinite`: what becomes of "
          "edges of indefinite information: 'refuse' (FileError says how many they are), "
          "'nearest' (the nearest semi-definite matrix) or 'isotropic' (one weight for "
          "translation and one for rotation).")
      .def(
          "write_g2o",
          [](const PoseGraph& g, const std::filesystem::path& path) {
            const PoseGraph copy = g;
            const WithoutGil released;
            write_g2o(path.string(), copy);
          },
          "path"_a, doc("write_g2o"))
      .def(
          "add_node",
          [](PoseGraph& g, std::int64_t id, nb::object pose, bool fixed) {
            g.nodes.push_back({NodeId(id), fitting_pose(g, pose, "pose"), fixed});
          },
          "id"_a, "pose"_a, "fixed"_a = false,
          "Adds a node; `pose` is an SE2, SE3 or Sim3, a row, or a matrix (3 x 3 or 4 x 4).\n\n"
          "See check().")
      .def("add_edge", &add_edge, "from_"_a, "to"_a, "measurement"_a, "information"_a,
           "source"_a = "odometry", "kernel"_a = RobustKernel(),
           "Adds a measured pose T_from_to of node `to` relative to node `from_`, with its "
           "information (D x D).\n\n`measurement` is what add_node takes. See check().")
      .def("add_position", &add_position, "node"_a, "position"_a, "information"_a,
           "lever_arm"_a = nb::none(), "kernel"_a = RobustKernel(),
           "Adds the measured position [m] of a point that a node carries, such as an antenna.\n\n"
           "error = T_world_node * lever_arm - position, with its information (3 x 3). Without a "
           "lever arm the point is the node's origin. In the plane the third components are "
           "ignored. See check().")
      .def("set_poses", &set_poses, "poses"_a,
           "Replaces all poses by rows as those of `poses`, or by matrices.")
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
          "copy", [](const PoseGraph& g) { return g; }, "A graph with the same content.");
}

}  // namespace placegraph::python
