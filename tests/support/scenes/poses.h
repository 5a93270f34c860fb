#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/lie.h>

namespace placegraph::test {

inline SE3 pose(const Eigen::Vector3d& rotation_rad, const Eigen::Vector3d& translation_m) {
  return SE3(SO3::exp(rotation_rad), translation_m);
}

inline double distance_m(const SE3& a, const SE3& b) {
  return (a.translation() - b.translation()).norm();
}
inline double angle_rad(const SE3& a, const SE3& b) {
  return (a.rotation().inverse() * b.rotation()).log().norm();
}
/// Norm of the logarithm of the motion from a to b: of translation [m], rotation [rad] and, of a
/// similarity, the logarithm of the scale.
template <class Group>
double difference(const Group& a, const Group& b) {
  return (a.inverse() * b).log().norm();
}

/// A small random motion [m], [rad].
inline SE3 random_motion(Random& random, double sigma_m, double sigma_rad) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.normal() * (i < 3 ? sigma_m : sigma_rad);
  return SE3::exp(xi);
}
/// The same, with every coordinate uniform up to a bound.
inline SE3 uniform_motion(Random& random, double most_m, double most_rad) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-1, 1) * (i < 3 ? most_m : most_rad);
  return SE3::exp(xi);
}

}  // namespace placegraph::test
