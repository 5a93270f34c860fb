#pragma once
#include <ceres/manifold.h>
#include <placegraph/backend/factors/variable.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace placegraph {

/// A variable's [+] and [-] as a Ceres manifold.
///
/// Factors write their derivatives with respect to the tangent xi into the first kDof columns of a
/// block's Jacobian and zeros into the rest, so the derivative of [+] is returned as [I; 0]: Ceres'
/// chain rule then yields the tangent derivative itself, and factors need no derivatives by the
/// over-parametrized block.
template <class T>
class VariableManifold final : public ceres::Manifold {
 public:
  using Block = VariableBlock<T>;
  using Tangent = typename Block::Tangent;
  static constexpr double kMaxLogScaleStep = 20;

  int AmbientSize() const override { return Block::kSize; }
  int TangentSize() const override { return Block::kDof; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    Tangent xi = Eigen::Map<const Tangent>(delta);
    if (!xi.allFinite()) return false;
    // Ceres tries a step along the whole negative gradient and fails if that is invalid: its scale
    // must stay a positive number. No useful step is that large.
    if constexpr (std::is_same_v<T, Sim3>)
      xi[6] = std::clamp(xi[6], -kMaxLogScaleStep, kMaxLogScaleStep);
    Block::store(Block::plus(Block::load(x), xi), x_plus_delta);
    for (int i = 0; i < Block::kSize; ++i)
      if (!std::isfinite(x_plus_delta[i])) return false;
    if constexpr (std::is_same_v<T, Sim3>) return x_plus_delta[7] > 0.0;
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    constexpr int order = Block::kDof == 1 ? Eigen::ColMajor : Eigen::RowMajor;
    Eigen::Map<Eigen::Matrix<double, Block::kSize, Block::kDof, order>> J(jacobian);
    J.setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Tangent>{y_minus_x} = Block::minus(Block::load(y), Block::load(x));
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    constexpr int order = Block::kSize == 1 ? Eigen::ColMajor : Eigen::RowMajor;
    Eigen::Map<Eigen::Matrix<double, Block::kDof, Block::kSize, order>> J(jacobian);
    J.setIdentity();
    return true;
  }
};

}  // namespace placegraph
