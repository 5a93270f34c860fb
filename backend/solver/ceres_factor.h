#pragma once
#include <ceres/cost_function.h>
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

/// A Factor of any size as a Ceres cost function on the blocks of its variables: see
/// VariableManifold, and CeresFactor for factors whose type is known. For one thread. If r or a
/// derivative is not finite, the evaluation fails and the solver tries a shorter step.
class DynamicCeresFactor final : public ceres::CostFunction {
 public:
  /// `factor` must outlive this object; `values` are any values of the kinds that it takes.
  DynamicCeresFactor(const Factor& factor, std::vector<Variable> values)
      : factor_(factor), values_(std::move(values)) {
    set_num_residuals(factor_.residual_size());
    for (const Variable& value : values_) {
      mutable_parameter_block_sizes()->push_back(block_size(value));
      J_.emplace_back(num_residuals(), degrees_of_freedom(value));
      pointers_.push_back(&value);
    }
  }
  DynamicCeresFactor(const DynamicCeresFactor&) = delete;
  DynamicCeresFactor& operator=(const DynamicCeresFactor&) = delete;

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    for (std::size_t k = 0; k < values_.size(); ++k) load_block(parameters[k], values_[k]);
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    const std::span<Eigen::MatrixXd> J(J_.data(), jacobians ? J_.size() : 0);
    if (!factor_.evaluate(pointers_, r, J) || !r.allFinite()) return false;
    for (std::size_t k = 0; k < J.size(); ++k) {
      if (!jacobians[k]) continue;
      if (!J[k].allFinite()) return false;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> ambient(
          jacobians[k], num_residuals(), parameter_block_sizes()[k]);
      ambient.setZero();
      ambient.leftCols(J[k].cols()) = J[k];
    }
    return true;
  }

 private:
  const Factor& factor_;
  // Buffers of one evaluation, with the right kinds and sizes.
  mutable std::vector<Variable> values_;
  std::vector<const Variable*> pointers_;
  mutable std::vector<Eigen::MatrixXd> J_;
};

}  // namespace placegraph
