#pragma once
#include <ceres/cost_function.h>
#include <gtest/gtest.h>
#include <placegraph/backend/factors/variable_manifold.h>

#include <vector>

namespace placegraph::test {

/// One parameter block of a factor: its values, and its manifold if it has one.
struct Block {
  std::vector<double> x;
  const ceres::Manifold* manifold = nullptr;

  int tangent_size() const {
    return manifold ? manifold->TangentSize() : static_cast<int>(x.size());
  }
  std::vector<double> plus(const Eigen::VectorXd& delta) const {
    std::vector<double> y = x;
    if (manifold) {
      manifold->Plus(x.data(), delta.data(), y.data());
    } else {
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += delta[static_cast<Eigen::Index>(i)];
    }
    return y;
  }
};

template <class Group>
Block pose_block(const Group& T, const VariableManifold<Group>& manifold) {
  Block block{std::vector<double>(VariableBlock<Group>::kSize), &manifold};
  VariableBlock<Group>::store(T, block.x.data());
  return block;
}

inline Eigen::VectorXd evaluate(const ceres::CostFunction& factor,
                                const std::vector<std::vector<double>>& x,
                                std::vector<double*>* jacobians = nullptr) {
  std::vector<const double*> pointers;
  for (const auto& block : x) pointers.push_back(block.data());
  Eigen::VectorXd r(factor.num_residuals());
  EXPECT_TRUE(factor.Evaluate(pointers.data(), r.data(), jacobians ? jacobians->data() : nullptr));
  return r;
}

/// Compares a factor's tangent Jacobians with central differences of fourth order: `tolerance` is
/// relative to the largest entry of the block or 1.
inline void expect_jacobians_match(const ceres::CostFunction& factor,
                                   const std::vector<Block>& blocks, double tolerance = 1e-8) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int rows = factor.num_residuals();
  std::vector<std::vector<double>> x;
  std::vector<RowMajor> ambient;
  for (const Block& block : blocks) {
    x.push_back(block.x);
    ambient.emplace_back(RowMajor::Constant(rows, static_cast<Eigen::Index>(block.x.size()), 1e99));
  }
  std::vector<double*> pointers;
  for (RowMajor& J : ambient) pointers.push_back(J.data());
  evaluate(factor, x, &pointers);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const int dof = blocks[k].tangent_size();
    RowMajor plus = RowMajor::Identity(static_cast<Eigen::Index>(blocks[k].x.size()), dof);
    if (blocks[k].manifold) blocks[k].manifold->PlusJacobian(blocks[k].x.data(), plus.data());
    const Eigen::MatrixXd analytic = ambient[k] * plus;
    Eigen::MatrixXd numeric(rows, dof);
    const double h = 1e-3;
    for (int j = 0; j < dof; ++j) {
      const auto at = [&](double step) {
        std::vector<std::vector<double>> moved = x;
        moved[k] = blocks[k].plus(Eigen::VectorXd::Unit(dof, j) * step);
        return evaluate(factor, moved);
      };
      numeric.col(j) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    }
    const double size = std::max(1.0, numeric.cwiseAbs().maxCoeff());
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), tolerance * size)
        << "block " << k << "\nanalytic\n"
        << analytic << "\nnumeric\n"
        << numeric;
  }
}

}  // namespace placegraph::test
