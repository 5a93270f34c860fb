#include <fmt/format.h>
#include <placegraph/backend/incremental/incremental_optimizer.h>

#include <cmath>
#include <limits>

#include "python/src/backend/graphs.h"
#include "python/src/options.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Optimizer = Exclusive<IncrementalOptimizer>;

void bind_step(nb::module_& m) {
  using Step = IncrementalStep;
  nb::class_<Step>(m, "IncrementalStep",
                   "Report of one step of the incremental optimizer.\n\n"
                   "`ok` is False if the cost exceeds its minimum by more than was requested; the "
                   "poses can still be used. It is also False if the normal equations cannot be "
                   "factorized with any damping, because a constraint has numbers that are "
                   "infinite, NaN or very large: then only newly connected nodes have moved, and "
                   "steps succeed again once that constraint is removed.")
      .def_prop_ro(
          "ok", [](const Step& s) { return static_cast<bool>(s.outcome); },
          "Whether the requested accuracy was reached.")
      .def_prop_ro(
          "reason", [](const Step& s) { return s.outcome.reason; },
          "Why it was not reached; empty otherwise.")
      .def_ro("first_constraint", &Step::first_constraint, doc("IncrementalStep::first_constraint"))
      .def_ro("iterations", &Step::iterations, doc("IncrementalStep::iterations"))
      .def_ro("nodes_moved", &Step::nodes_moved, doc("IncrementalStep::nodes_moved"))
      .def_ro("nodes_refactored", &Step::nodes_refactored, doc("IncrementalStep::nodes_refactored"))
      .def_ro("edges_relinearized", &Step::edges_relinearized,
              doc("IncrementalStep::edges_relinearized"))
      .def_ro("solved_from_scratch", &Step::solved_from_scratch,
              doc("IncrementalStep::solved_from_scratch"))
      .def_ro("cost", &Step::cost, doc("IncrementalStep::cost"))
      .def_ro("predicted_excess", &Step::predicted_excess, doc("IncrementalStep::predicted_excess"))
      .def("__repr__", [](const Step& s) {
        return fmt::format("<IncrementalStep: cost {:.6g}, {} iterations, {} nodes moved>", s.cost,
                           s.iterations, s.nodes_moved);
      });
}

IncrementalStep reweight(Optimizer& o, const ArrayArgument<std::int64_t>& constraints,
                         const ArrayArgument<double>& weights) {
  const auto numbers = constraints.get("constraints", {kAny});
  const auto values = weights.get("weights", {static_cast<int>(numbers.shape(0))});
  std::vector<ConstraintWeight> list;
  for (std::size_t i = 0; i < numbers.shape(0); ++i) {
    require(numbers.data()[i] >= 0 && numbers.data()[i] <= std::numeric_limits<int>::max(),
            fmt::format("constraints: there is no constraint {}", numbers.data()[i]));
    list.push_back({static_cast<int>(numbers.data()[i]), values.data()[i]});
  }
  return o.change([&](IncrementalOptimizer& optimizer) { return optimizer.reweight(list); });
}

nb::any pose(Optimizer& o, std::int64_t id) {
  const std::optional<Pose> found = o.get().pose(NodeId(id));
  require(found.has_value(), fmt::format("id: there is no node {}", id));
  return std::visit([](const auto& T) { return as_any(nb::cast(T)); }, *found);
}

}  // namespace

void bind_incremental(nb::module_& m) {
  bind_step(m);
  nb::class_<Optimizer>(m, "IncrementalOptimizerCore", doc("IncrementalOptimizer"))
      .def(
          "__init__",
          [](Optimizer* self, const OptionSet& options, const PoseGraph* graph) {
            const auto& typed = options_in<IncrementalOptions>(options, "options");
            new (self) Optimizer("IncrementalOptimizer", graph ? IncrementalOptimizer(typed, *graph)
                                                               : IncrementalOptimizer(typed));
          },
          "options"_a, "graph"_a = nb::none())
      .def(
          "add",
          [](Optimizer& o, PoseGraph added) {
            return o.change([&](IncrementalOptimizer& optimizer) {
              return optimizer.add(added.nodes, added.constraints);
            });
          },
          "added"_a, doc("IncrementalOptimizer::add"))
      .def("reweight", &reweight, "constraints"_a, "weights"_a,
           doc("IncrementalOptimizer::reweight"))
      .def(
          "remove_constraint",
          [](Optimizer& o, int constraint) {
            return o.change([&](IncrementalOptimizer& optimizer) {
              return optimizer.remove_constraint(constraint);
            });
          },
          "constraint"_a, doc("IncrementalOptimizer::remove_constraint"))
      .def(
          "finish",
          [](Optimizer& o) {
            return o.change([](IncrementalOptimizer& optimizer) { return optimizer.finish(); });
          },
          doc("IncrementalOptimizer::finish"))
      .def("pose", &pose, "id"_a, "The current pose T_world_node of a node.")
      .def_prop_ro(
          "graph", [](Optimizer& o) { return o.get().graph(); }, doc("IncrementalOptimizer::graph"))
      .def_prop_ro(
          "constraints", [](Optimizer& o) { return o.get().constraints(); },
          doc("IncrementalOptimizer::constraints"))
      .def_prop_ro(
          "cost", [](Optimizer& o) { return o.get().cost(); }, doc("IncrementalOptimizer::cost"))
      .def(
          "covariance",
          [](Optimizer& o, const ArrayArgument<std::int64_t>& ids) {
            const std::vector<NodeId> nodes = node_ids(ids);
            return o.run(
                [&](const IncrementalOptimizer& optimizer) { return optimizer.covariance(nodes); });
          },
          "ids"_a, doc("IncrementalOptimizer::covariance"))
      .def(
          "relative_covariance",
          [](Optimizer& o, std::int64_t from, std::int64_t to) {
            return Eigen::MatrixXd(o.run([&](const IncrementalOptimizer& optimizer) {
              return optimizer.relative_covariance(NodeId(from), NodeId(to));
            }));
          },
          "from_"_a, "to"_a, doc("IncrementalOptimizer::relative_covariance"));
}

}  // namespace placegraph::python
