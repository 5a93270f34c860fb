#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured distance between the origins of two poses, in standard deviations:
///
///   r = (|t_b - t_a| - distance) / sigma,   u = (t_b - t_a) / |t_b - t_a|
///   d r / d xi_a = [-u^T R_a, 0] / sigma,   d r / d xi_b = [u^T R_b, 0] / sigma
///
/// (T exp(xi) moves the origin by R rho.) If the origins coincide, the direction is undefined and
/// the derivatives are zero. The poses are SE2 or SE3.
template <class Group>
class DistanceFactorOf final : public SizedFactor<1, Group, Group> {
  using Base = SizedFactor<1, Group, Group>;
  static constexpr int kDim = Group::kDof == 3 ? 2 : 3;
  using Row = Eigen::Matrix<double, 1, kDim>;

 public:
  /// Measured distance and its standard deviation, which must be positive.
  DistanceFactorOf(double distance_m, double sigma_m)
      : distance_(distance_m), inverse_(1.0 / sigma_m) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const Group& T_map_a, const Group& T_map_b, typename Base::Residual& r,
               typename Base::Jacobians* J) const override {
    const Row t_a_b_map = (T_map_b.translation() - T_map_a.translation()).transpose();
    const double length = t_a_b_map.norm();
    r[0] = (length - distance_) * inverse_;
    if (!J) return true;
    const Row u = length > 1e-12 ? Row(t_a_b_map / length) : Row(Row::Zero());
    std::get<0>(*J).setZero();
    std::get<1>(*J).setZero();
    std::get<0>(*J).template leftCols<kDim>() = -inverse_ * u * T_map_a.rotation().matrix();
    std::get<1>(*J).template leftCols<kDim>() = inverse_ * u * T_map_b.rotation().matrix();
    return true;
  }
  /// The distance and its standard deviation in the new scale.
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    const auto result = std::make_shared<DistanceFactorOf>(*this);
    result->distance_ *= S_new_old.scale();
    result->inverse_ /= S_new_old.scale();
    return result;
  }

 private:
  double distance_, inverse_;
};

/// A measured distance between two poses in space.
using DistanceFactor = DistanceFactorOf<SE3>;

}  // namespace placegraph
