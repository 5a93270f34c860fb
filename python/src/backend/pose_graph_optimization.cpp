#include <fmt/format.h>
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/core/error.h>

#include "python/src/backend/graphs.h"
#include "python/src/options.h"
#include "python/src/values/value_class.h"
#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// The report of an optimization, and the certificate if it was asked for.
struct OptimizedGraph {
  PoseGraphReport report;
  std::optional<ChordalIsotropicCertificate> certificate;
};

OptimizedGraph optimize(PoseGraph graph, const OptionSet& options, bool with_certificate,
                        nb::handle on_step) {
  const PoseGraphOptions typed = options_in<PoseGraphOptions>(options, "options");
  const WithoutGil released;
  OptimizedGraph result;
  result.report = optimize_pose_graph(std::move(graph), typed, steps_to(on_step));
  if (!result.report.outcome) throw NoResult("graph: " + result.report.outcome.reason);
  if (with_certificate && !result.report.graph.nodes.empty())
    result.certificate = certify_chordal_isotropic(
        without_rejected(result.report.graph, result.report.rejected), typed.rotation_error);
  return result;
}

std::vector<std::int64_t> free_nodes(const OptimizedGraph& o) {
  std::vector<std::int64_t> ids;
  for (const int node : o.report.free.nodes)
    ids.push_back(o.report.graph.nodes[static_cast<std::size_t>(node)].id.value());
  return ids;
}

std::string text_of(const OptimizedGraph& o) {
  const PoseGraphReport& r = o.report;
  std::string text = fmt::format(
      "<OptimizedGraph: {} nodes, chi2 {:.6g} -> {:.6g}, {} iterations, initialization {}",
      r.graph.nodes.size(), r.chi2_initial, r.chi2_final, r.iterations,
      to_string(r.initialization_used));
  if (!r.rejected.empty()) text += fmt::format(", {} constraints rejected", r.rejected.size());
  if (o.certificate) text += o.certificate->certified ? ", certified" : ", not certified";
  for (const Doubt& doubt : r.doubts) text += "; " + doubt.text;
  return text + ">";
}

void bind_parts(nb::module_& m) {
  nb::class_<RejectedEdge> rejected(m, "RejectedEdge", doc("RejectedEdge"));
  bind_value(rejected, Hash::kByValue);
  rejected.def_ro("constraint", &RejectedEdge::constraint, doc("RejectedEdge::constraint"))
      .def_ro("chi2", &RejectedEdge::chi2, doc("RejectedEdge::chi2"))
      .def_ro("reason", &RejectedEdge::reason, doc("RejectedEdge::reason"))
      .def("__repr__", [](const RejectedEdge& e) {
        return fmt::format("RejectedEdge(constraint={}, chi2={:.6g}, reason='{}')", e.constraint,
                           e.chi2, e.reason);
      });
  using Certificate = ChordalIsotropicCertificate;
  nb::class_<Certificate> certificate(m, "Certificate", doc("ChordalIsotropicCertificate"));
  bind_value(certificate, Hash::kByValue);
  certificate
      .def_ro("certified", &Certificate::certified,
              "Whether `relative_gap` is at most 1e-5 and no pose is rotated by more than 0.3 rad "
              "from the minimum that was found, which is therefore that of the estimate.")
      .def_ro("cost", &Certificate::cost, doc("ChordalIsotropicCertificate::cost"))
      .def_ro("cost_of_estimate", &Certificate::cost_of_estimate,
              doc("ChordalIsotropicCertificate::cost_of_estimate"))
      .def_ro("lower_bound", &Certificate::lower_bound,
              doc("ChordalIsotropicCertificate::lower_bound"))
      .def_ro(
          "relative_gap", &Certificate::relative_gap,
          "Gap between the cost of that minimum and the lower bound, relative to the cost; of the "
          "estimate if it belongs to another minimum.")
      .def_ro("smallest_eigenvalue", &Certificate::smallest_eigenvalue,
              doc("ChordalIsotropicCertificate::smallest_eigenvalue"))
      .def_ro("eigenvalue_scale", &Certificate::eigenvalue_scale,
              doc("ChordalIsotropicCertificate::eigenvalue_scale"))
      .def("__repr__", [](const Certificate& c) {
        return fmt::format("<placegraph.Certificate: {}, relative gap {:.3g}>",
                           c.certified ? "certified" : "not certified", c.relative_gap);
      });
}

void bind_report(nb::module_& m) {
  using O = OptimizedGraph;
  nb::class_<O> optimized(m, "OptimizedGraph", doc("PoseGraphReport"));
  bind_value(optimized, Hash::kNone);
  optimized
      .def_prop_ro(
          "ok", [](const O& o) { return static_cast<bool>(o.report.outcome); },
          "Whether a minimum was reached.")
      .def_prop_ro(
          "reason", [](const O& o) { return o.report.outcome.reason; },
          "Why no minimum was reached; empty otherwise.")
      .def_prop_ro(
          "graph", [](O& o) -> PoseGraph& { return o.report.graph; },
          nb::rv_policy::reference_internal, doc("PoseGraphReport::graph"))
      .def_prop_ro(
          "chi2_initial", [](const O& o) { return o.report.chi2_initial; },
          doc("PoseGraphReport::chi2_initial"))
      .def_prop_ro(
          "chi2_final", [](const O& o) { return o.report.chi2_final; },
          doc("PoseGraphReport::chi2_final"))
      .def_prop_ro(
          "chi2_kept", [](const O& o) { return o.report.chi2_final; }, "The same as chi2_final.")
      .def_prop_ro(
          "degrees_of_freedom", [](const O& o) { return o.report.degrees_of_freedom; },
          doc("PoseGraphReport::degrees_of_freedom"))
      .def_prop_ro(
          "doubts", [](const O& o) { return TupleOf<std::string>{texts_of(o.report.doubts)}; },
          "What speaks against the result, one line each, as the command warns of it.")
      .def_prop_ro(
          "iterations", [](const O& o) { return o.report.iterations; },
          doc("PoseGraphReport::iterations"))
      .def_prop_ro(
          "initialization", [](const O& o) { return to_string(o.report.initialization_used); },
          "Initialization of the selected descent: file, odometry, chordal or certified.")
      .def_prop_ro(
          "refined_from_certified", [](const O& o) { return o.report.refined_from_certified; },
          "Whether `initialization` is 'certified'.")
      .def_prop_ro(
          "chi2_by_constraint",
          [](nb::handle self) {
            const std::vector<double>& chi2 = nb::cast<const O&>(self).report.chi2_by_constraint;
            return ReadOnlyArray<double>(chi2.data(), {chi2.size()}, self);
          },
          "Squared error of each constraint at the optimized poses (a view).")
      .def_prop_ro(
          "rejected", [](const O& o) { return TupleOf{o.report.rejected}; },
          doc("PoseGraphReport::rejected"))
      .def_prop_ro(
          "loops_judged", [](const O& o) { return o.report.loops_judged; },
          doc("PoseGraphReport::loops_judged"))
      .def_prop_ro(
          "free_directions", [](const O& o) { return o.report.free.count; }, doc("FreeDirections"))
      .def_prop_ro("free_nodes", as_tuple(&free_nodes),
                   "Ids of the nodes that the free directions move.")
      .def_prop_ro(
          "certificate", [](const O& o) { return o.certificate; },
          "How far the solution is from the global minimum, if that was asked for.")
      .def("__repr__", &text_of);
}

ReadOnlyArray<double> stacked(const std::vector<Information>& matrices, int size) {
  const auto dof = static_cast<std::size_t>(size);
  std::vector<double> values;
  std::size_t count = 0;
  for (const Information& matrix : matrices) {
    if (matrix.size() == 0) continue;  // a constraint of another kind
    append_rows(matrix, values);
    ++count;
  }
  return owned_array(std::move(values), {count, dof, dof});
}

/// The marginals of a graph and the kind of its poses.
struct Marginals {
  PoseMarginals marginals;
  PoseKind kind;
};

PoseKind kind_of(const PoseGraph& graph) { return graph.kind(); }
PoseKind kind_of(const LandmarkGraph& graph) { return graph.poses.kind(); }

/// Throws if the constraints leave directions undetermined: nothing can be asked for then.
template <class Graph>
Marginals marginals_of(const Graph& graph, const std::string& rotation_error) {
  const RotationError error = rotation_error_of(rotation_error);
  const WithoutGil released;
  Marginals result{PoseMarginals(graph, error), kind_of(graph)};
  if (!result.marginals.outcome())
    throw NoResult("graph: no covariances: " + result.marginals.outcome().reason);
  return result;
}

void bind_marginals(nb::module_& m) {
  const auto released = nb::call_guard<WithoutGil>();
  nb::class_<Marginals>(m, "PoseMarginals", doc("PoseMarginals"))
      .def(
          "__init__",
          [](Marginals* self, const PoseGraph& graph, const std::string& rotation_error) {
            new (self) Marginals(marginals_of(graph, rotation_error));
          },
          "graph"_a, "rotation_error"_a = "log",
          "Makes the factorization. Raises NoResult if the constraints leave directions "
          "undetermined.")
      .def(
          "__init__",
          [](Marginals* self, const LandmarkGraph& graph, const std::string& rotation_error) {
            new (self) Marginals(marginals_of(graph, rotation_error));
          },
          "graph"_a, "rotation_error"_a = "log", "The same of a graph with priors and points.")
      .def(
          "covariance",
          [](const Marginals& p, std::int64_t id) {
            return Eigen::MatrixXd(p.marginals.covariance(NodeId(id)));
          },
          "id"_a, released, doc("PoseMarginals::covariance"))
      .def(
          "covariances",
          [](const Marginals& p) {
            std::vector<Information> all;
            {
              const WithoutGil released;
              all = p.marginals.covariances();
            }
            return stacked(all, degrees_of_freedom(p.kind));
          },
          doc("PoseMarginals::covariances"))
      .def(
          "point_covariances",
          [](const Marginals& p) {
            std::vector<Information> all;
            {
              const WithoutGil released;
              all = p.marginals.point_covariances();
            }
            return stacked(all, p.kind == PoseKind::kSE2 ? 2 : 3);
          },
          "Covariances of all points of a LandmarkGraph in the axes of the world [m^2], N x 3 x 3, "
          "in the plane N x 2 x 2.")
      .def(
          "joint_covariance",
          [](const Marginals& p, const ArrayArgument<std::int64_t>& ids) {
            const std::vector<NodeId> nodes = node_ids(ids);
            const WithoutGil released;
            return p.marginals.joint_covariance(nodes);
          },
          "ids"_a, doc("PoseMarginals::joint_covariance"))
      .def(
          "relative_covariance",
          [](const Marginals& p, std::int64_t from, std::int64_t to) {
            return Eigen::MatrixXd(p.marginals.relative_covariance(NodeId(from), NodeId(to)));
          },
          "from_"_a, "to"_a, released, doc("PoseMarginals::relative_covariance"))
      .def(
          "edge_covariances",
          [](const Marginals& p) {
            std::vector<Information> all;
            {
              const WithoutGil released;
              all = p.marginals.constraint_covariances();
            }
            return stacked(all, degrees_of_freedom(p.kind));
          },
          "Covariances in the graph of the measured relative poses, M x D x D, as `edges`.");
}

}  // namespace

void bind_pose_graph_optimization(nb::module_& m) {
  bind_parts(m);
  bind_report(m);
  bind_marginals(m);
  m.def("optimize_pose_graph", &optimize, "graph"_a, "options"_a, "certify"_a = false,
        "on_step"_a = nb::none(), doc("optimize_pose_graph"));
}

}  // namespace placegraph::python
