#pragma once
#include <placegraph/backend/factors/factor.h>

namespace placegraph {

/// A known height of a sensor above a plane, e.g. of a vehicle's camera above the ground.
/// In standard deviations:
///
///   r = (s (n^T t - d) - height) / sigma,   s = sign of n^T t - d
///   d r / d xi = [s n^T R, 0] / sigma,      d r / d w: see Plane3::distance_to
class HeightAbovePlaneFactor final : public SizedFactor<1, SE3, Plane3> {
 public:
  HeightAbovePlaneFactor(double height_m, double sigma_m)
      : height_(height_m), inverse_sigma_(1.0 / sigma_m) {}

  bool compute(const SE3& T_world_sensor, const Plane3& plane_world, Residual& r,
               Jacobians* J) const override {
    Eigen::RowVector3d J_plane;
    const double signed_height =
        plane_world.distance_to(T_world_sensor.translation(), J ? &J_plane : nullptr);
    const double toward = signed_height < 0 ? -inverse_sigma_ : inverse_sigma_;
    r[0] = toward * signed_height - inverse_sigma_ * height_;
    if (!J) return true;
    std::get<0>(*J) << toward * plane_world.normal().transpose() *
                           T_world_sensor.rotation().matrix(),
        0, 0, 0;
    std::get<1>(*J) = toward * J_plane;
    return true;
  }
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    const auto result = std::make_shared<HeightAbovePlaneFactor>(*this);
    result->height_ *= S_new_old.scale();
    result->inverse_sigma_ /= S_new_old.scale();
    return result;
  }

 private:
  double height_, inverse_sigma_;
};

}  // namespace placegraph
