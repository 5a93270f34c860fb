#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>

#include <vector>

namespace placegraph {

/// The graph without some variables, by position, which are marginalized.
/// Their terms are linearized at the values of the graph, with the weights of their kernels, and
/// replaced by one linear prior (LinearPriorFactor) on the variables that share a term with them.
/// Variables that are held are constants. A term that cannot be computed there is lost.
FactorGraph marginalized(const FactorGraph& graph, const std::vector<char>& leaves);

}  // namespace placegraph
