#include <placegraph/io/synthetic/defects/camera_motion.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

/// The value at the share `s` of an interval from `a` to `b` with these slopes, each times the
/// length of the interval; beyond the interval straight on.
template <class Vector>
Vector hermite(const Vector& a, const Vector& b, const Vector& slope_a, const Vector& slope_b,
               double s) {
  if (s < 0) return a + s * slope_a;
  if (s > 1) return b + (s - 1) * slope_b;
  const double r = 1 - s;
  return r * r * (1 + 2 * s) * a + s * s * (1 + 2 * r) * b + s * r * (r * slope_a - s * slope_b);
}

}  // namespace

SE3 pose_at(const std::vector<double>& time_s, const std::vector<SE3>& T_scene_cam, double at_s) {
  const int n = static_cast<int>(time_s.size());
  if (n < 2) return T_scene_cam.front();
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), at_s);
  const int i = std::clamp(static_cast<int>(next - time_s.begin()) - 1, 0, n - 2);
  if (at_s == time_s[i]) return T_scene_cam[i];
  // The four poses against the one before `at_s`: positions, and rotations as rotation vectors.
  const int index[4] = {std::max(0, i - 1), i, i + 1, std::min(n - 1, i + 2)};
  Vector6d near[4];
  for (int k = 0; k < 4; ++k) {
    const SE3& T = T_scene_cam[index[k]];
    near[k] << T.translation() - T_scene_cam[i].translation(),
        (T_scene_cam[i].rotation().inverse() * T.rotation()).log();
  }
  const auto interval_s = [&](int k) { return time_s[index[k + 1]] - time_s[index[k]]; };
  // The velocity at near[k] of the parabola through it and its neighbours, or of a straight line.
  const auto velocity = [&](int k) -> Vector6d {
    const double before_s = interval_s(k - 1), after_s = interval_s(k);
    const Vector6d before = near[k] - near[k - 1], after = near[k + 1] - near[k];
    if (before_s <= 0) return after / after_s;
    if (after_s <= 0) return before / before_s;
    return (before * (after_s / before_s) + after * (before_s / after_s)) / (before_s + after_s);
  };
  const double length_s = interval_s(1);
  const Vector6d step = hermite<Vector6d>(near[1], near[2], length_s * velocity(1),
                                          length_s * velocity(2), (at_s - time_s[i]) / length_s);
  return SE3(T_scene_cam[i].rotation() * SO3::exp(step.tail<3>()),
             T_scene_cam[i].translation() + step.head<3>());
}

}  // namespace placegraph::synthetic
