#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/variable_manifold.h>

namespace placegraph {

template <class F, class Tuple>
class CeresFactorOf;

/// A SizedFactor as a Ceres cost function on the blocks of its variables: see VariableManifold.
template <class F>
using CeresFactor = CeresFactorOf<F, typename F::VariableTuple>;

template <class F, class... Variables>
class CeresFactorOf<F, std::tuple<Variables...>> final
    : public ceres::SizedCostFunction<F::kRows, VariableBlock<Variables>::kSize...> {
 public:
  explicit CeresFactorOf(F factor) : factor_(std::move(factor)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    return evaluate(parameters, residuals, jacobians, std::index_sequence_for<Variables...>());
  }

 private:
  template <std::size_t... I>
  bool evaluate(double const* const* parameters, double* residuals, double** jacobians,
                std::index_sequence<I...>) const {
    typename F::Residual r;
    typename F::Jacobians J;
    if (!factor_.F::compute(VariableBlock<Variables>::load(parameters[I])..., r,
                            jacobians ? &J : nullptr))
      return false;
    Eigen::Map<typename F::Residual>{residuals} = r;
    if (jacobians) (store<Variables>(std::get<I>(J), jacobians[I]), ...);
    return true;
  }
  template <class T>
  static void store(const FactorJacobian<F::kRows, T>& J, double* ambient) {
    using Block = VariableBlock<T>;
    if (!ambient) return;
    constexpr int order = Block::kSize == 1 ? Eigen::ColMajor : Eigen::RowMajor;
    Eigen::Map<Eigen::Matrix<double, F::kRows, Block::kSize, order>> out(ambient);
    out.template leftCols<Block::kDof>() = J;
    out.template rightCols<Block::kSize - Block::kDof>().setZero();
  }

  F factor_;
};

}  // namespace placegraph
