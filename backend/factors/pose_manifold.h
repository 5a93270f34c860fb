#pragma once
#include <ceres/manifold.h>
#include <placegraph/graph/core/lie.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

/// How a group element lies in a parameter block: `kSize` doubles, `store` and `load`.
template <class Group>
struct PoseBlock;

/// [x, y, angle]
template <>
struct PoseBlock<SE2> {
  static constexpr int kSize = 3;
  static void store(const SE2& T, double* x) {
    x[0] = T.translation()[0];
    x[1] = T.translation()[1];
    x[2] = T.rotation().angle();
  }
  static SE2 load(const double* x) { return SE2(x[0], x[1], x[2]); }
};

/// [qx, qy, qz, qw, x, y, z]
template <>
struct PoseBlock<SE3> {
  static constexpr int kSize = 7;
  static void store(const SE3& T, double* x) {
    Eigen::Map<Eigen::Vector4d>{x} = T.rotation().quaternion().coeffs();
    Eigen::Map<Eigen::Vector3d>(x + 4) = T.translation();
  }
  static SE3 load(const double* x) {
    return SE3(SO3(Eigen::Quaterniond(x)),
               Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 4)));
  }
};

/// [qx, qy, qz, qw, x, y, z, scale]
template <>
struct PoseBlock<Sim3> {
  static constexpr int kSize = 8;
  static void store(const Sim3& S, double* x) {
    Eigen::Map<Eigen::Vector4d>{x} = S.rotation().quaternion().coeffs();
    Eigen::Map<Eigen::Vector3d>(x + 4) = S.translation();
    x[7] = S.scale();
  }
  static Sim3 load(const double* x) {
    return Sim3(SO3(Eigen::Quaterniond(x)),
                Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 4)), x[7]);
  }
};

/// T [+] xi = T exp(xi), y [-] x = log(x^-1 y).
///
/// The factors of this folder write their derivatives with respect to the tangent xi into the first
/// kDof columns of a block's Jacobian and zeros into the rest, so the derivative of [+] is handed
/// out as [I; 0]: Ceres' chain rule then yields the tangent derivative itself, and no factor has to
/// go by way of the over-parametrized block.
template <class Group>
class PoseManifold final : public ceres::Manifold {
 public:
  using Block = PoseBlock<Group>;
  static constexpr double kMaxLogScaleStep = 20;

  int AmbientSize() const override { return Block::kSize; }
  int TangentSize() const override { return Group::kDof; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    using Tangent = typename Group::Tangent;
    Tangent xi = Eigen::Map<const Tangent>(delta);
    if (!xi.allFinite()) return false;
    // Ceres tries out the whole negative gradient and gives up if that fails: the scale of that
    // must stay a positive number. No useful step is as large.
    if constexpr (Group::kDof == 7) xi[6] = std::clamp(xi[6], -kMaxLogScaleStep, kMaxLogScaleStep);
    Block::store(Block::load(x).plus(xi), x_plus_delta);
    for (int i = 0; i < Block::kSize; ++i)
      if (!std::isfinite(x_plus_delta[i])) return false;
    if constexpr (Group::kDof == 7) return x_plus_delta[7] > 0.0;
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, Block::kSize, Group::kDof, Eigen::RowMajor>> J(jacobian);
    J.setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    using Tangent = typename Group::Tangent;
    Eigen::Map<Tangent>{y_minus_x} = (Block::load(x).inverse() * Block::load(y)).log();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, Group::kDof, Block::kSize, Eigen::RowMajor>> J(jacobian);
    J.setIdentity();
    return true;
  }
};

}  // namespace placegraph
