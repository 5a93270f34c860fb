#include <fmt/format.h>
#include <placegraph/backend/factor_graph/fixed_lag_smoother.h>

#include <algorithm>
#include <utility>

#include "python/src/backend/graphs.h"
#include "python/src/options.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Smoother = Exclusive<FixedLagSmoother>;

const FactorGraph::Node& node_of(const FactorGraph& graph, int variable) {
  require(variable >= 0 && static_cast<std::size_t>(variable) < graph.variables.size(),
          fmt::format("variable: there is no variable {}", variable));
  return graph.variables[static_cast<std::size_t>(variable)];
}

FactorGraph::Node& node_of(FactorGraph& graph, int variable) {
  return const_cast<FactorGraph::Node&>(node_of(std::as_const(graph), variable));
}

FactorGraph::Term term_of(const NamedFactor& factor, std::vector<int> variables,
                          const RobustKernel& kernel) {
  return {factor.factor, std::move(variables), kernel};
}

void add_term(FactorGraph& graph, const NamedFactor& factor, const std::vector<int>& variables,
              const RobustKernel& kernel) {
  // The check of a graph with these variables and this term alone: others were checked before.
  FactorGraph alone;
  std::vector<int> positions, seen;
  for (const int variable : variables) {
    const FactorGraph::Node& node = node_of(graph, variable);
    const auto found = std::find(seen.begin(), seen.end(), variable);
    positions.push_back(static_cast<int>(found - seen.begin()));
    if (found != seen.end()) continue;
    seen.push_back(variable);
    alone.add_variable(node.value);
  }
  alone.terms.push_back(term_of(factor, positions, kernel));
  try {
    alone.check();
  } catch (const ArgumentError& error) {
    throw ArgumentError(fmt::format("factor {}: {}", factor.name, error.what()));
  }
  graph.terms.push_back(term_of(factor, variables, kernel));
}

void add_residual(FactorGraph& graph, nb::object residual, const std::vector<int>& variables,
                  nb::object jacobian, nb::handle sigma, nb::handle information,
                  const RobustKernel& kernel, const std::string& name) {
  std::vector<Variable> values;
  for (const int variable : variables) values.push_back(node_of(graph, variable).value);
  const NamedFactor factor =
      custom_factor(std::move(residual), values, std::move(jacobian), sigma, information, name);
  add_term(graph, factor, variables, kernel);
}

void set_value(FactorGraph& graph, int variable, nb::handle value) {
  FactorGraph::Node& node = node_of(graph, variable);
  const Variable changed = variable_of(value, "value");
  require(changed.index() == node.value.index(),
          fmt::format("value: variable {} is a {}, not a {}", variable, kind_name(node.value),
                      kind_name(changed)));
  node.value = changed;
}

FactorGraphReport optimize(const FactorGraph& graph, const OptionSet& options, nb::handle on_step) {
  const FactorGraph copy = graph;
  const FactorGraphOptions typed = options_in<FactorGraphOptions>(options, "options");
  const WithoutGil released;
  return optimize_factor_graph(copy, typed, steps_to(on_step));
}

Eigen::MatrixXd matrix_of(MarginalCovariance&& marginal) {
  if (!marginal.outcome) throw Error("graph: no covariance: " + marginal.outcome.reason);
  return std::move(marginal.covariance);
}

Eigen::MatrixXd covariance(const FactorGraph& graph, const std::vector<int>& variables) {
  const FactorGraph copy = graph;
  const WithoutGil released;
  return matrix_of(marginal_covariance(copy, variables));
}

nb::object term_at(const FactorGraph& graph, int number) {
  require(number >= 0 && static_cast<std::size_t>(number) < graph.terms.size(),
          fmt::format("term: there is no term {}", number));
  const FactorGraph::Term& term = graph.terms[static_cast<std::size_t>(number)];
  const nb::object variables = nb::cast(term.variables);
  return nb::make_tuple(NamedFactor{term.factor, fmt::format("of term {}", number)},
                        nb::tuple(variables), term.kernel);
}

std::string text_of(const FactorGraph& graph) {
  return fmt::format("<FactorGraph: {} variables, {} terms>", graph.variables.size(),
                     graph.terms.size());
}

/// For the garbage collector: the graph of an object that refers to functions of Python.
FactorGraph* graph_in(FactorGraph& graph) { return &graph; }
const FactorGraph* graph_in(Smoother& smoother) {
  const FixedLagSmoother* at_rest = smoother.at_rest();
  return at_rest ? &at_rest->window() : nullptr;
}

void forget_terms(FactorGraph& graph) {
  // They are destroyed after the graph has forgotten them: their functions may use it.
  std::vector<FactorGraph::Term> terms;
  std::swap(terms, graph.terms);
}
void forget_terms(Smoother& smoother) {
  if (FixedLagSmoother* at_rest = smoother.at_rest()) {
    const FixedLagSmoother old = std::exchange(*at_rest, FixedLagSmoother(0));
  }
}

template <class Owner>
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const FactorGraph* graph = graph_in(*nb::inst_ptr<Owner>(self));
  if (!graph) return 0;
  for (const FactorGraph::Term& term : graph->terms)
    if (const int stop = visit_functions(term, visit, arg)) return stop;
  return 0;
}

template <class Owner>
int clear(PyObject* self) {
  if (nb::inst_ready(self)) forget_terms(*nb::inst_ptr<Owner>(self));
  return 0;
}

template <class Owner>
PyType_Slot garbage_slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse<Owner>)},
                               {Py_tp_clear, reinterpret_cast<void*>(clear<Owner>)},
                               {0, nullptr}};

void bind_graph(nb::module_& m) {
  nb::class_<FactorGraph>(m, "FactorGraph", nb::type_slots(garbage_slots<FactorGraph>),
                          doc("FactorGraph"))
      .def(nb::init<>(), "An empty graph.")
      .def_static(
          "from_pose_graph",
          [](const PoseGraph& graph, const std::string& rotation_error) {
            return to_factor_graph(graph, rotation_error_of(rotation_error));
          },
          "graph"_a, "rotation_error"_a = "log",
          "Converts a pose graph: variables in the order of the nodes, terms in the order of the "
          "constraints.\n\n"
          "The fixed nodes and those that `optimize` would hold are held. `rotation_error`: 'log' "
          "or 'quaternion'. Raises ArgumentError as PoseGraph.check.")
      .def(
          "add_variable",
          [](FactorGraph& g, nb::handle value, bool held) {
            const Variable variable = variable_of(value, "value");
            require(is_finite(variable), "value: it is not finite");
            return g.add_variable(variable, held);
          },
          "value"_a, "held"_a = false, doc("FactorGraph::add_variable"))
      .def("add", &add_term, "factor"_a, "variables"_a, "kernel"_a = RobustKernel(),
           "Adds a factor of variables, given by their positions in the order that it takes.")
      .def("add_residual", &add_residual, "residual"_a, "variables"_a, nb::kw_only(),
           "jacobian"_a = nb::none(), "sigma"_a = nb::none(), "information"_a = nb::none(),
           "kernel"_a = RobustKernel(), "name"_a = "",
           "Adds a factor written in Python, see Factor.custom. `residual` is called here once, at "
           "the present values, which give the number of its rows.")
      .def(
          "value",
          [](const FactorGraph& g, int i) { return as_any(object_of(node_of(g, i).value)); },
          "variable"_a, "The value of a variable.")
      .def("set_value", &set_value, "variable"_a, "value"_a,
           "Gives a variable another value of its kind.")
      .def(
          "kind", [](const FactorGraph& g, int i) { return kind_name(node_of(g, i).value); },
          "variable"_a, "The kind of a variable.")
      .def(
          "is_held", [](const FactorGraph& g, int i) { return node_of(g, i).held; }, "variable"_a,
          doc("FactorGraph::Node::held"))
      .def(
          "hold", [](FactorGraph& g, int i, bool held) { node_of(g, i).held = held; }, "variable"_a,
          "held"_a = true, "Sets whether optimization keeps a value fixed.")
      .def(
          "squared_residuals",
          [](const FactorGraph& g) { return squared_residuals(FactorGraph(g)); },
          "Squared residual |r|^2 of every term at the current values, without kernels.\n\n"
          "None for a term whose residual cannot be computed. Raises ArgumentError for a graph "
          "that is invalid.")
      .def("covariance", &covariance, "variables"_a,
           "Joint covariance of the tangents of selected variables; the others are "
           "marginalized.\n\n"
           "It consists of blocks of (J^T J)^-1 at the current values; kernels enter by their "
           "weights. Raises ArgumentError for a graph that is invalid and if a variable does not "
           "exist, repeats or is held.")
      .def(
          "copy", [](const FactorGraph& g) { return g; }, "A graph with the same content.")
      .def("term", &term_at, "term"_a,
           nb::sig("def term(self, term: int) -> tuple[Factor, tuple[int, ...], RobustKernel]"),
           "The factor of a term, its variables in the factor's order, and its kernel.")
      .def_prop_ro(
          "terms", [](const FactorGraph& g) { return g.terms.size(); }, "Number of terms.")
      .def("__len__", [](const FactorGraph& g) { return g.variables.size(); })
      .def("__repr__", &text_of);
}

void bind_report(nb::module_& m) {
  using Report = FactorGraphReport;
  nb::class_<Report>(m, "FactorGraphReport", doc("FactorGraphReport"))
      .def_prop_ro(
          "ok", [](const Report& r) { return static_cast<bool>(r.outcome); },
          "Whether a minimum was reached.")
      .def_prop_ro(
          "reason", [](const Report& r) { return r.outcome.reason; },
          "Why no minimum was reached; empty otherwise.")
      .def_prop_ro(
          "graph", [](const Report& r) { return r.graph; }, "The graph with the estimate.")
      .def_ro("cost_initial", &Report::cost_initial, "Half the sum of rho(|r|^2) before.")
      .def_ro("cost_final", &Report::cost_final, "The same at the estimate.")
      .def_ro("iterations", &Report::iterations, doc("FactorGraphReport::iterations"))
      .def("__repr__", [](const Report& r) {
        return fmt::format("<FactorGraphReport: cost {:.6g} -> {:.6g}, {} iterations{}{}>",
                           r.cost_initial, r.cost_final, r.iterations, r.outcome ? "" : ", ",
                           r.outcome.reason);
      });
  m.def("optimize_factor_graph", &optimize, "graph"_a, "options"_a, "on_step"_a = nb::none(),
        "Minimizes sum rho(|r|^2) / 2 by Levenberg-Marquardt from the current values.\n\n"
        "If most variables are points and lines, these are eliminated first. Directions that no "
        "term determines stay near their initial values. Deterministic, single-threaded. Raises "
        "ArgumentError for a graph that is invalid and for options out of range. An exception of a "
        "factor ends the optimization and is raised here.");
}

void bind_smoother(nb::module_& m) {
  using Step = FixedLagStep;
  nb::class_<Step>(m, "FixedLagStep", doc("FixedLagStep"))
      .def_prop_ro(
          "ok", [](const Step& s) { return static_cast<bool>(s.outcome); },
          "Whether a minimum was reached.")
      .def_prop_ro(
          "reason", [](const Step& s) { return s.outcome.reason; },
          "Why no minimum was reached; empty otherwise.")
      .def_ro("cost_initial", &Step::cost_initial, "Half the sum of rho(|r|^2) before.")
      .def_ro("cost_final", &Step::cost_final, "The same at the estimate.")
      .def_ro("iterations", &Step::iterations, doc("FixedLagStep::iterations"))
      .def_prop_ro("marginalized", as_tuple(&Step::marginalized),
                   doc("FixedLagStep::marginalized"));
  nb::class_<Smoother>(m, "FixedLagSmootherCore", nb::type_slots(garbage_slots<Smoother>),
                       doc("FixedLagSmoother"))
      .def(
          "__init__",
          [](Smoother* self, double lag, const OptionSet& options) {
            new (self)
                Smoother("FixedLagSmoother",
                         FixedLagSmoother(lag, options_in<FactorGraphOptions>(options, "options")));
          },
          "lag"_a, "options"_a)
      .def(
          "add_variable",
          [](Smoother& s, double time, nb::handle value, bool held) {
            return s.get().add_variable(time, variable_of(value, "value"), held);
          },
          "time"_a, "value"_a, "held"_a = false, doc("FixedLagSmoother::add_variable"))
      .def(
          "add",
          [](Smoother& s, const NamedFactor& factor, const std::vector<int>& variables,
             const RobustKernel& kernel) { s.get().add(term_of(factor, variables, kernel)); },
          "factor"_a, "variables"_a, "kernel"_a = RobustKernel(),
          "Adds a factor of variables in the window, in the order that it takes.")
      .def(
          "touch", [](Smoother& s, int variable, double time) { s.get().touch(variable, time); },
          "variable"_a, "time"_a, doc("FixedLagSmoother::touch"))
      .def(
          "update",
          [](Smoother& s) {
            return s.run(
                [](FixedLagSmoother& smoother) { return smoother.update(python_warnings()); });
          },
          doc("FixedLagSmoother::update"))
      .def_prop_ro(
          "variables", [](Smoother& s) { return TupleOf{s.get().variables()}; },
          doc("FixedLagSmoother::variables"))
      .def(
          "value", [](Smoother& s, int i) { return as_any(object_of(s.get().value(i))); },
          "variable"_a, doc("FixedLagSmoother::value"))
      .def(
          "covariance",
          [](Smoother& s, const std::vector<int>& variables) {
            return s.run([&](const FixedLagSmoother& smoother) {
              return matrix_of(smoother.covariance(variables));
            });
          },
          "variables"_a, doc("FixedLagSmoother::covariance"))
      .def(
          "window", [](Smoother& s) { return s.get().window(); }, doc("FixedLagSmoother::window"));
}

}  // namespace

void bind_factor_graph(nb::module_& m) {
  nb::class_<OptionSetOf<FactorGraphOptions>, OptionSet>(m, "FactorGraphOptionSet",
                                                         doc("FactorGraphOptions"))
      .def(nb::init<>(), "The defaults.");
  bind_graph(m);
  bind_report(m);
  bind_smoother(m);
}

}  // namespace placegraph::python
