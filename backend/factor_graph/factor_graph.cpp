#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/solver/packed_graph.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <string>

namespace placegraph {
namespace {

std::string kinds(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return "(" + text + ")";
}

std::string kind_of_index(std::size_t index) {
  static const Variable kEach[] = {
      0.0, SE2(), SE3(), Sim3(), SO3(), Eigen::Vector3d(0, 0, 0), Line3(), Plane3(), Marker()};
  return index < std::size(kEach) ? kind_name(kEach[index]) : "unknown";
}

void check_term(const FactorGraph& graph, const FactorGraph::Term& term, const std::string& name) {
  require(term.factor != nullptr, name + " has no factor");
  require(term.factor->residual_size() > 0, name + " has no residuals");
  require(term.kernel.kind == RobustKernel::Kind::kNone ||
              (std::isfinite(term.kernel.width) && term.kernel.width > 0),
          name + ": the kernel's width must be positive");
  std::vector<int> sorted = term.variables;
  std::sort(sorted.begin(), sorted.end());
  require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(),
          name + " has a variable twice");
  std::vector<std::string> given, taken;
  for (const int variable : term.variables) {
    require(variable >= 0 && static_cast<std::size_t>(variable) < graph.variables.size(),
            name + ": there is no variable " + std::to_string(variable));
    given.push_back(kind_name(graph.variables[static_cast<std::size_t>(variable)].value));
  }
  for (const std::size_t kind : term.factor->variable_kinds()) taken.push_back(kind_of_index(kind));
  require(given == taken, name + " takes " + kinds(taken) + ", given " + kinds(given));
}

template <class Group>
FactorGraph convert(const PoseGraph& graph, RotationError rotation_error) {
  const PackedGraph<Group> packed = pack<Group>(graph);
  FactorGraph result;
  for (std::size_t i = 0; i < packed.poses.size(); ++i)
    result.add_variable(packed.poses[i], packed.components.held[i]);
  result.terms.resize(graph.constraints.size());
  for (const auto& edge : packed.edges)
    result.terms[static_cast<std::size_t>(edge.constraint)] = {
        std::make_shared<RelativePoseFactor<Group>>(edge.T_to_from.inverse(),
                                                    whitening(edge.information), rotation_error),
        {edge.from, edge.to},
        edge.kernel};
  for (const auto& position : packed.positions)
    result.terms[static_cast<std::size_t>(position.constraint)] = {
        std::make_shared<PositionFactor<Group>>(position.position_world, position.lever_arm,
                                                whitening(position.information)),
        {position.node},
        position.kernel};
  return result;
}

}  // namespace

int FactorGraph::add_variable(const Variable& value, bool held) {
  variables.push_back({value, held});
  return static_cast<int>(variables.size()) - 1;
}

const Variable& FactorGraph::value_of_kind(int variable, std::size_t kind) const {
  require(variable >= 0 && static_cast<std::size_t>(variable) < variables.size(),
          "factor graph: there is no variable " + std::to_string(variable));
  const Variable& found = variables[static_cast<std::size_t>(variable)].value;
  require(found.index() == kind, "factor graph: variable " + std::to_string(variable) + " is a " +
                                     kind_name(found) + ", not a " + kind_of_index(kind));
  return found;
}

void FactorGraph::check() const {
  for (std::size_t i = 0; i < variables.size(); ++i)
    require(is_finite(variables[i].value),
            "factor graph: variable " + std::to_string(i) + " is not finite");
  for (std::size_t i = 0; i < terms.size(); ++i)
    check_term(*this, terms[i], "factor graph: term " + std::to_string(i));
}

std::vector<std::optional<double>> squared_residuals(const FactorGraph& graph) {
  graph.check();
  std::vector<std::optional<double>> squares;
  squares.reserve(graph.terms.size());
  std::vector<const Variable*> values;
  for (const FactorGraph::Term& term : graph.terms) {
    values.clear();
    for (const int i : term.variables)
      values.push_back(&graph.variables[static_cast<std::size_t>(i)].value);
    Eigen::VectorXd r(term.factor->residual_size());
    if (term.factor->evaluate(values, r, {}))
      squares.emplace_back(r.squaredNorm());
    else
      squares.emplace_back();
  }
  return squares;
}

FactorGraph to_factor_graph(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return convert<SE2>(graph, rotation_error);
    case PoseKind::kSE3:
      return convert<SE3>(graph, rotation_error);
    case PoseKind::kSim3:
      return convert<Sim3>(graph, rotation_error);
  }
  throw ArgumentError("factor graph: poses of an unknown kind");
}

}  // namespace placegraph
