#include <fmt/format.h>
#include <placegraph/backend/factor_graph/landmark_graph_optimizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <filesystem>

#include "python/src/backend/graphs.h"
#include "python/src/frontend/functions.h"
#include "python/src/options.h"
#include "python/src/values/value_class.h"
#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Integers = ReadOnlyArray<std::int64_t>;
using Numbers = ReadOnlyArray<double>;

std::size_t dimension(const LandmarkGraph& graph) {
  return graph.poses.kind() == PoseKind::kSE2 ? 2 : 3;
}

/// A column of ids of the entries of a list.
template <class Entry>
Integers ids_of(const std::vector<Entry>& entries, NodeId Entry::*id) {
  std::vector<std::int64_t> ids;
  for (const Entry& entry : entries) ids.push_back((entry.*id).value());
  const std::size_t count = ids.size();
  return owned_array(std::move(ids), {count});
}

/// Rows of vectors of the entries of a list, N x 3, or N x 2 in the plane.
template <class Entry>
Numbers rows_of(const LandmarkGraph& graph, const std::vector<Entry>& entries,
                Eigen::Vector3d Entry::*vector) {
  const std::size_t width = dimension(graph);
  std::vector<double> values;
  for (const Entry& entry : entries)
    values.insert(values.end(), (entry.*vector).data(), (entry.*vector).data() + width);
  return owned_array(std::move(values), {entries.size(), width});
}

Eigen::Vector3d vector_of(const ArrayArgument<double>& value, const char* argument,
                          std::size_t width) {
  const auto array = value.get(argument, {static_cast<int>(width)});
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  std::copy_n(array.data(), width, vector.data());
  return vector;
}

Eigen::MatrixXd matrix_of(const ArrayArgument<double>& value, const char* argument, int size) {
  const auto array = value.get(argument, {size, size});
  return Eigen::Map<const Eigen::MatrixXd>(array.data(), size, size);
}

/// Adds an entry, or leaves the graph as it was and throws.
template <class Entry>
void add(LandmarkGraph& graph, std::vector<Entry> LandmarkGraph::*list, Entry entry) {
  (graph.*list).push_back(std::move(entry));
  try {
    graph.check();
  } catch (...) {
    (graph.*list).pop_back();
    throw;
  }
}

LandmarkGraph read(const std::filesystem::path& file, const std::string& indefinite) {
  const auto how =
      choice_of<IndefiniteInformation>(indefinite, indefinite_information_names(), "indefinite");
  const std::string path = file.string();
  std::vector<std::string> remarks;
  LandmarkGraph graph;
  {
    const WithoutGil released;
    graph = read_landmark_graph(path, {.connected = false, .remarks = &remarks, .indefinite = how});
  }
  for (const std::string& remark : remarks) warn(path + ": " + remark);
  return graph;
}

void bind_graph(nb::module_& m) {
  using G = LandmarkGraph;
  nb::class_<G> graph(m, "LandmarkGraph", doc("LandmarkGraph"));
  bind_value(graph, Hash::kNone);
  graph
      .def(
          "__init__",
          [](G* self, PoseGraph poses) {
            new (self) G{std::move(poses), {}, {}, {}};
          },
          "poses"_a, "The graph of these poses, without priors and points.")
      .def_static(
          "read", &read, "path"_a, "indefinite"_a = "refuse",
          "Reads a pose graph with its priors and points.\n\n`indefinite`: as of PoseGraph.read.")
      .def(
          "write",
          [](const G& g, const std::filesystem::path& file) {
            const WithoutGil released;
            write_g2o(file.string(), g);
          },
          "path"_a, "Writes the graph in the g2o format; the file is replaced as a whole.")
      .def(
          "add_point",
          [](G& g, std::int64_t id, const ArrayArgument<double>& position, bool fixed) {
            add(g, &G::points,
                GraphPoint{NodeId(id), vector_of(position, "position", dimension(g)), fixed});
          },
          "id"_a, "position"_a, "fixed"_a = false,
          "Adds a point at a position in the world [m], 3 or, in the plane, 2 numbers.")
      .def(
          "add_observation",
          [](G& g, std::int64_t node, std::int64_t point, const ArrayArgument<double>& position,
             const ArrayArgument<double>& information) {
            const auto size = static_cast<int>(dimension(g));
            PointObservation observation{NodeId(node), NodeId(point),
                                         vector_of(position, "position", dimension(g)),
                                         Eigen::Matrix3d::Identity()};
            observation.information.topLeftCorner(size, size) =
                matrix_of(information, "information", size);
            add(g, &G::observations, observation);
          },
          "node"_a, "point"_a, "position"_a, "information"_a, doc("PointObservation"))
      .def(
          "add_prior",
          [](G& g, std::int64_t node, nb::handle pose, const ArrayArgument<double>& information) {
            add(g, &G::priors,
                PosePriorConstraint{NodeId(node), pose_of(pose, "pose"),
                                    Information(matrix_of(information, "information",
                                                          degrees_of_freedom(g.poses.kind()))),
                                    false});
          },
          "node"_a, "pose"_a, "information"_a, doc("PosePriorConstraint"))
      .def_prop_ro(
          "poses", [](const G& g) { return g.poses; }, "A copy of the nodes and their constraints.")
      .def_prop_ro(
          "point_ids", [](const G& g) { return ids_of(g.points, &GraphPoint::id); }, kNew,
          "Ids of the points, N.")
      .def_prop_ro(
          "points", [](const G& g) { return rows_of(g, g.points, &GraphPoint::position_world); },
          kNew, "Positions of the points in the world [m], N x 3, in the plane N x 2.")
      .def_prop_ro(
          "observing_nodes",
          [](const G& g) { return ids_of(g.observations, &PointObservation::node); }, kNew,
          "Nodes of the observations, M.")
      .def_prop_ro(
          "observed_points",
          [](const G& g) { return ids_of(g.observations, &PointObservation::point); }, kNew,
          "Points of the observations, M.")
      .def_prop_ro(
          "observed_positions",
          [](const G& g) { return rows_of(g, g.observations, &PointObservation::position_node); },
          kNew, "Measured positions in the axes of their nodes [m], M x 3, in the plane M x 2.")
      .def_prop_ro(
          "prior_nodes", [](const G& g) { return ids_of(g.priors, &PosePriorConstraint::node); },
          kNew, "Nodes of the measured poses, K.")
      .def_prop_ro(
          "prior_poses",
          [](const G& g) {
            std::vector<double> values;
            for (const PosePriorConstraint& prior : g.priors)
              append_row(prior.T_world_node, values);
            return owned_array(std::move(values), {g.priors.size(), row_width(g.poses.kind())});
          },
          kNew, "The measured poses, K rows as of PoseGraph.poses.")
      .def("check", &G::check, doc("LandmarkGraph::check"))
      .def(
          "chi2",
          [](const G& g, const std::string& rotation_error) {
            const RotationError error = rotation_error_of(rotation_error);
            const WithoutGil released;
            return chi2(g, error);
          },
          "rotation_error"_a = "log",
          "Sum of e^T Omega e over edges, measured positions, priors and observations.")
      .def("__repr__", [](const G& g) {
        return fmt::format(
            "<placegraph.LandmarkGraph: {} nodes, {} constraints, {} priors, {} "
            "points, {} observations>",
            g.poses.nodes.size(), g.poses.constraints.size(), g.priors.size(), g.points.size(),
            g.observations.size());
      });
}

LandmarkGraphReport optimize(LandmarkGraph graph, const OptionSet& options, nb::handle on_step) {
  const PoseGraphOptions typed = options_in<PoseGraphOptions>(options, "options");
  require(typed.robust.method == RobustMethod::kNone,
          "robust: no robust method takes a graph with priors and points");
  const WithoutGil released;
  LandmarkGraphReport report = optimize_landmark_graph(
      std::move(graph),
      {typed.rotation_error, typed.engine, typed.max_iterations, typed.relative_decrease},
      steps_to(on_step));
  if (!report.outcome) throw NoResult("graph: " + report.outcome.reason);
  return report;
}

void bind_report(nb::module_& m) {
  using R = LandmarkGraphReport;
  nb::class_<R> report(m, "OptimizedLandmarkGraph", doc("LandmarkGraphReport"));
  bind_outcome(report);
  bind_value(report, Hash::kNone);
  report
      .def_prop_ro(
          "graph", [](R& r) -> LandmarkGraph& { return r.graph; },
          nb::rv_policy::reference_internal, doc("LandmarkGraphReport::graph"))
      .def_ro("chi2_initial", &R::chi2_initial, "Sum of e^T Omega e before.")
      .def_ro("chi2_final", &R::chi2_final, "Sum of e^T Omega e at the estimate.")
      .def_ro("degrees_of_freedom", &R::degrees_of_freedom,
              doc("LandmarkGraphReport::degrees_of_freedom"))
      .def_ro("iterations", &R::iterations, doc("LandmarkGraphReport::iterations"))
      .def_prop_ro(
          "doubts", [](const R& r) { return TupleOf<std::string>{texts_of(r.doubts)}; },
          doc("LandmarkGraphReport::doubts"))
      .def("__repr__", [](const R& r) {
        std::string text = fmt::format(
            "<OptimizedLandmarkGraph: {} nodes, {} points, chi2 {:.6g} -> {:.6g}, {} iterations",
            r.graph.poses.nodes.size(), r.graph.points.size(), r.chi2_initial, r.chi2_final,
            r.iterations);
        for (const Doubt& doubt : r.doubts) text += "; " + doubt.text;
        return text + ">";
      });
}

}  // namespace

void bind_landmark_graphs(nb::module_& m) {
  bind_graph(m);
  bind_report(m);
  m.def("optimize_landmark_graph", &optimize, "graph"_a, "options"_a, "on_step"_a = nb::none(),
        doc("optimize_landmark_graph"));
}

}  // namespace placegraph::python
