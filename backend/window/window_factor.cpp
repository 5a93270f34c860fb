#include <placegraph/backend/window/window_factor.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {

bool touches(const WindowFactor& factor, const WindowVariable& variable) {
  return std::find(factor.variables.begin(), factor.variables.end(), variable) !=
         factor.variables.end();
}

void check(const WindowFactor& factor, const std::string& name) {
  require(factor.factor != nullptr, name + ": there is no factor");
  const std::vector<std::size_t> kinds = factor.factor->variable_kinds();
  require(kinds.size() == factor.variables.size(),
          name + ": the factor takes " + std::to_string(kinds.size()) + " variables, not " +
              std::to_string(factor.variables.size()));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const WindowVariable& variable = factor.variables[k];
    require(factor_kind(variable) == kinds[k],
            name + ": the factor takes a variable of another kind than " + to_string(variable));
    require(std::count(factor.variables.begin(), factor.variables.end(), variable) == 1,
            name + ": " + to_string(variable) + " repeats");
  }
  require(factor.factor->transformed(Sim3()) != nullptr,
          name + ": the factor cannot be transformed to another frame");
}

WindowFactor transformed(const WindowFactor& factor, const Sim3& S_new_old) {
  WindowFactor result = factor;
  result.factor = factor.factor->transformed(S_new_old);
  return result;
}

}  // namespace placegraph
