#pragma once
#include <gtest/gtest.h>
#include <placegraph/backend/factors/factor.h>

#include <vector>

namespace placegraph::test {

inline Eigen::VectorXd evaluate(const Factor& factor, const std::vector<Variable>& values,
                                std::vector<Eigen::MatrixXd>* jacobians = nullptr) {
  std::vector<const Variable*> pointers;
  for (const Variable& value : values) pointers.push_back(&value);
  if (jacobians)
    for (const Variable& value : values)
      jacobians->emplace_back(
          Eigen::MatrixXd::Constant(factor.residual_size(), degrees_of_freedom(value), 1e99));
  Eigen::VectorXd r(factor.residual_size());
  EXPECT_TRUE(factor.evaluate(
      pointers, r,
      jacobians ? std::span<Eigen::MatrixXd>(*jacobians) : std::span<Eigen::MatrixXd>()));
  return r;
}

/// Compares a factor's Jacobians with central differences of fourth order: `tolerance` is relative
/// to the largest entry of the block or 1.
inline void expect_jacobians_match(const Factor& factor, const std::vector<Variable>& values,
                                   double tolerance = 1e-8) {
  std::vector<Eigen::MatrixXd> analytic;
  evaluate(factor, values, &analytic);
  for (std::size_t k = 0; k < values.size(); ++k) {
    Eigen::MatrixXd numeric(factor.residual_size(), degrees_of_freedom(values[k]));
    const double h = 1e-3;
    for (Eigen::Index j = 0; j < numeric.cols(); ++j) {
      const auto at = [&](double step) {
        std::vector<Variable> moved = values;
        moved[k] = plus(values[k], Eigen::VectorXd::Unit(numeric.cols(), j) * step);
        return evaluate(factor, moved);
      };
      numeric.col(j) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    }
    const double size = std::max(1.0, numeric.cwiseAbs().maxCoeff());
    EXPECT_LT((analytic[k] - numeric).cwiseAbs().maxCoeff(), tolerance * size)
        << "variable " << k << "\nanalytic\n"
        << analytic[k] << "\nnumeric\n"
        << numeric;
  }
}

}  // namespace placegraph::test
