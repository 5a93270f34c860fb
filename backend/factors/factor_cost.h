#pragma once
#include <ceres/cost_function.h>
#include <placegraph/backend/factors/factor.h>

namespace placegraph {

/// A Factor of any size as a Ceres cost function on the blocks of its variables: see
/// VariableManifold, and CeresFactor for factors whose type is known. For one thread. Where r or a
/// derivative is not finite the evaluation fails: the solver then tries a shorter step.
class FactorCost final : public ceres::CostFunction {
 public:
  /// `factor` must outlive it; `values` are any of the kinds that it takes.
  FactorCost(const Factor& factor, std::vector<Variable> values)
      : factor_(factor), values_(std::move(values)) {
    set_num_residuals(factor_.residual_size());
    for (const Variable& value : values_) {
      mutable_parameter_block_sizes()->push_back(block_size(value));
      J_.emplace_back(num_residuals(), degrees_of_freedom(value));
      pointers_.push_back(&value);
    }
  }
  FactorCost(const FactorCost&) = delete;
  FactorCost& operator=(const FactorCost&) = delete;

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
  // Room for one evaluation, of the right kinds and sizes.
  mutable std::vector<Variable> values_;
  std::vector<const Variable*> pointers_;
  mutable std::vector<Eigen::MatrixXd> J_;
};

}  // namespace placegraph
