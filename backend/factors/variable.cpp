#include <placegraph/backend/factors/variable.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

int degrees_of_freedom(const Variable& variable) {
  return std::visit([](const auto& x) { return VariableBlock<std::decay_t<decltype(x)>>::kDof; },
                    variable);
}

const char* kind_name(const Variable& variable) {
  static constexpr const char* kNames[] = {"scalar", "SE2",  "SE3",   "Sim3",  "rotation",
                                           "point",  "line", "plane", "marker"};
  static_assert(std::size(kNames) == std::variant_size_v<Variable>);
  return kNames[variable.index()];
}

int block_size(const Variable& variable) {
  return std::visit([](const auto& x) { return VariableBlock<std::decay_t<decltype(x)>>::kSize; },
                    variable);
}

void store_block(const Variable& variable, double* block) {
  std::visit([&](const auto& x) { VariableBlock<std::decay_t<decltype(x)>>::store(x, block); },
             variable);
}

void load_block(const double* block, Variable& variable) {
  std::visit([&](auto& x) { x = VariableBlock<std::decay_t<decltype(x)>>::load(block); }, variable);
}

Eigen::VectorXd minus(const Variable& y, const Variable& x) {
  require(y.index() == x.index(), std::string("a difference between variables of kinds ") +
                                      kind_name(y) + " and " + kind_name(x));
  return std::visit(
      [&](const auto& value) -> Eigen::VectorXd {
        using T = std::decay_t<decltype(value)>;
        return VariableBlock<T>::minus(value, std::get<T>(x));
      },
      y);
}

bool is_finite(const Variable& variable) {
  return std::visit(
      [](const auto& x) {
        using Block = VariableBlock<std::decay_t<decltype(x)>>;
        double block[Block::kSize];
        Block::store(x, block);
        return std::all_of(block, block + Block::kSize, [](double y) { return std::isfinite(y); });
      },
      variable);
}

Variable plus(const Variable& x, const Eigen::Ref<const Eigen::VectorXd>& xi) {
  require(xi.size() == degrees_of_freedom(x),
          std::string("a step of the wrong size for a variable of kind ") + kind_name(x));
  return std::visit(
      [&](const auto& value) -> Variable {
        using Block = VariableBlock<std::decay_t<decltype(value)>>;
        return Block::plus(value, typename Block::Tangent(xi));
      },
      x);
}

}  // namespace placegraph
