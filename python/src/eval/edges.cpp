#include <fmt/format.h>
#include <placegraph/eval/edges/edge_consistency.h>
#include <placegraph/eval/edges/edge_mount.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <nanobind/stl/map.h>

#include "python/src/arrays.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

using PoseByNode = std::map<std::int64_t, SE3>;
using FrameByNode = std::map<std::int64_t, int>;

/// The edges between poses of a graph.
std::vector<RelativePoseConstraint> edges_of(const PoseGraph& graph) {
  require(graph.kind() != PoseKind::kSE2, "graph: edges over SE(3) or Sim(3) are needed");
  std::vector<RelativePoseConstraint> edges;
  for (const Constraint& constraint : graph.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint)) edges.push_back(*edge);
  return edges;
}

TrueNodes nodes_of(const PoseByNode& poses, const std::optional<TruthNoise>& noise,
                   const FrameByNode& frames) {
  TrueNodes truth;
  for (const auto& [node, pose] : poses) truth.T_world_node.emplace(NodeId(node), pose);
  for (const auto& [node, frame] : frames) truth.frames.emplace(NodeId(node), frame);
  if (noise) truth.noise = *noise;
  require(truth.noise.outcome.code == Outcome::Code::kOk, truth.noise.outcome.reason);
  return truth;
}

/// The consistency of the edges of each source.
std::map<std::string, EdgeConsistency> consistency_of(const PoseGraph& graph,
                                                      const PoseByNode& poses,
                                                      const std::optional<TruthNoise>& noise,
                                                      const FrameByNode& frames,
                                                      const std::optional<TruthMount>& mount) {
  TrueNodes truth = nodes_of(poses, noise, frames);
  if (mount) truth = mounted(truth, *mount);
  std::map<std::string, EdgeConsistency> result;
  for (const auto& [source, consistency] : edge_consistency(edges_of(graph), truth))
    result.emplace(to_string(source), consistency);
  return result;
}

TruthMount mount_of(const PoseGraph& graph, const PoseByNode& poses,
                    const std::optional<TruthNoise>& noise, const FrameByNode& frames) {
  return fit_mount(edges_of(graph), nodes_of(poses, noise, frames));
}

/// The sentence of `placegraph eval edges` on edges of a source.
std::string sentence_on(const EdgeConsistency& consistency, const std::string& name) {
  const auto source = constraint_source(name);
  require(source.has_value(), "source: '" + name + "' is none of odometry, loop, other");
  return sentence_of(*source, consistency);
}

void bind_noise(nb::module_& m) {
  nb::class_<DirectionNoise> direction(m, "DirectionNoise", doc("DirectionNoise"));
  bind_value(direction, Hash::kByValue);
  direction.def_ro("frames", &DirectionNoise::frames, doc("DirectionNoise::frames"))
      .def_ro("lateral_rad", &DirectionNoise::lateral_rad, "Standard deviation, sideways [rad].")
      .def_ro("vertical_rad", &DirectionNoise::vertical_rad, "Standard deviation, upright [rad].")
      .def("__repr__", [](const DirectionNoise& n) {
        return fmt::format("<placegraph.DirectionNoise: {:.3g}, {:.3g} rad over {} frames>",
                           n.lateral_rad, n.vertical_rad, n.frames);
      });
  nb::class_<TruthNoise> noise(m, "TruthNoise", doc("TruthNoise"));
  bind_value(noise, Hash::kByValue);
  noise
      .def_static("white", &TruthNoise::white, "position_m"_a, "rotation_rad"_a,
                  doc("TruthNoise::white"))
      .def_prop_ro(
          "ok", [](const TruthNoise& n) { return bool(n.outcome); },
          "Whether there is an estimate; `reason` says why not.")
      .def_prop_ro(
          "reason", [](const TruthNoise& n) { return n.outcome.reason; },
          "Why there is no estimate; empty otherwise.")
      .def_ro("sigma", &TruthNoise::sigma, doc("TruthNoise::sigma"))
      .def_prop_ro("direction", as_tuple(&TruthNoise::direction), doc("TruthNoise::direction"))
      .def_prop_ro(
          "interpolated",
          [](const TruthNoise& n) {
            std::vector<std::pair<int, int>> stretches;
            for (const FrameStretch& s : n.interpolated) stretches.emplace_back(s.first, s.last);
            return TupleOf{stretches};
          },
          "First and last frame of each stretch whose poses were interpolated, not measured.")
      .def("covariance", &TruthNoise::covariance, "T_from_to"_a, "frames"_a,
           doc("TruthNoise::covariance"))
      .def("__repr__", [](const TruthNoise& n) {
        if (!n.outcome) return "<placegraph.TruthNoise: " + n.outcome.reason + ">";
        return fmt::format("<placegraph.TruthNoise: sigma [{:.3g}]>",
                           fmt::join(n.sigma.data(), n.sigma.data() + n.sigma.size(), ", "));
      });
  m.def("estimate_truth_noise", &estimate_truth_noise, "trajectory"_a, nb::call_guard<WithoutGil>(),
        doc("estimate_truth_noise"));
}

void bind_consistency(nb::module_& m) {
  nb::class_<Nees> nees(m, "Nees", doc("Nees"));
  bind_value(nees, Hash::kByValue);
  nees.def_ro("mean", &Nees::mean, doc("Nees::mean"))
      .def_ro("median", &Nees::median, "The median of the same.")
      .def_ro("share_beyond_99", &Nees::share_beyond_99, doc("Nees::share_beyond_99"))
      .def("__repr__", [](const Nees& n) {
        return fmt::format("<placegraph.Nees: mean {:.4g}, median {:.4g}, {:.3g} beyond 99 %>",
                           n.mean, n.median, n.share_beyond_99);
      });
  nb::class_<AxisConsistency> axis(m, "AxisConsistency", doc("AxisConsistency"));
  bind_value(axis, Hash::kByValue);
  axis.def_ro("name", &AxisConsistency::name, "What is tested, as 'rotation about y'.")
      .def_ro("error", &AxisConsistency::error, doc("AxisConsistency::error"))
      .def_ro("stated", &AxisConsistency::stated, doc("AxisConsistency::stated"))
      .def_ro("of_truth", &AxisConsistency::of_truth, doc("AxisConsistency::of_truth"))
      .def_ro("normalized", &AxisConsistency::normalized, doc("AxisConsistency::normalized"))
      .def("__repr__", [](const AxisConsistency& a) {
        return fmt::format("<placegraph.AxisConsistency of {}: error {:.3g}, stated {:.3g}>",
                           a.name, a.error, a.stated);
      });
  nb::class_<EdgeConsistency> edges(m, "EdgeConsistency", doc("EdgeConsistency"));
  bind_value(edges, Hash::kByValue);
  edges.def_ro("edges", &EdgeConsistency::edges, doc("EdgeConsistency::edges"))
      .def_ro("unknown", &EdgeConsistency::unknown, doc("EdgeConsistency::unknown"))
      .def_ro("interpolated", &EdgeConsistency::interpolated, doc("EdgeConsistency::interpolated"))
      .def_ro("degrees_of_freedom", &EdgeConsistency::degrees_of_freedom,
              doc("EdgeConsistency::degrees_of_freedom"))
      .def_ro("by_stated", &EdgeConsistency::by_stated, doc("EdgeConsistency::by_stated"))
      .def_ro("with_truth", &EdgeConsistency::with_truth, doc("EdgeConsistency::with_truth"))
      .def_ro("truth_share", &EdgeConsistency::truth_share, doc("EdgeConsistency::truth_share"))
      .def_prop_ro("axes", as_tuple(&EdgeConsistency::axes), doc("EdgeConsistency::axes"))
      .def_prop_ro(
          "mean_nees", [](const EdgeConsistency& c) { return c.by_stated.mean; },
          "The mean of `by_stated`.")
      .def_prop_ro(
          "median_nees", [](const EdgeConsistency& c) { return c.by_stated.median; },
          "The median of `by_stated`.")
      .def_prop_ro(
          "share_beyond_99", [](const EdgeConsistency& c) { return c.by_stated.share_beyond_99; },
          "The share of `by_stated`.")
      .def_prop_ro(
          "interval_95",
          [](const EdgeConsistency& c) {
            return nees_interval(c.with_truth, c.degrees_of_freedom);
          },
          "The interval of 95 % of the mean of `with_truth` for more edges of the same kind.")
      .def_prop_ro(
          "verdict", [](const EdgeConsistency& c) { return std::string(to_string(verdict_on(c))); },
          "'hold', 'too small', 'too large', 'not testable', 'too few edges' or 'no edges'.")
      .def("sentence", &sentence_on, "source"_a = "odometry",
           "The verdict as a sentence about the edges of a source.")
      .def("__repr__", [](const EdgeConsistency& c) {
        return fmt::format("<placegraph.EdgeConsistency of {} edges: {}, mean NEES {:.4g}>",
                           c.edges, to_string(verdict_on(c)), c.by_stated.mean);
      });
}

}  // namespace

void bind_edges(nb::module_& m) {
  bind_noise(m);
  bind_consistency(m);
  nb::class_<TruthMount> mount(m, "TruthMount", doc("TruthMount"));
  bind_value(mount, Hash::kByValue);
  mount.def_ro("T_truth_cam", &TruthMount::T_truth_cam, doc("TruthMount::T_truth_cam"))
      .def_ro("sigma", &TruthMount::sigma, doc("TruthMount::sigma"))
      .def_ro("parameters", &TruthMount::parameters, doc("TruthMount::parameters"))
      .def("__repr__", [](const TruthMount& each) {
        return fmt::format("<placegraph.TruthMount: {:.3g} of 6 parameters fitted>",
                           each.parameters);
      });
  m.def("fit_mount", &mount_of, "graph"_a, "truth"_a, "noise"_a = nb::none(),
        "frames"_a = FrameByNode(), nb::call_guard<WithoutGil>(), doc("fit_mount"));
  m.def(
      "edge_consistency", &consistency_of, "graph"_a, "truth"_a, "noise"_a = nb::none(),
      "frames"_a = FrameByNode(), "mount"_a = nb::none(), nb::call_guard<WithoutGil>(),
      "Errors of the edges of a pose graph over SE(3) or Sim(3), relative to their covariances, "
      "for each source of edges ('odometry', 'loop' ...).\n\n`truth`: true poses T_world_node by "
      "the ids of the nodes. `noise`: that of the truth, as of `estimate_truth_noise`; `frames`: "
      "the nodes' frames in its trajectory. `mount`: of `fit_mount`. Nothing else is fitted: only "
      "relative poses are compared.");
}

}  // namespace placegraph::python
