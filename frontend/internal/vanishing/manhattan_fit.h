#pragma once
#include <placegraph/frontend/internal/vanishing/vanishing_evidence.h>
#include <placegraph/graph/geometry/so3.h>

#include <array>
#include <vector>

namespace placegraph {

/// Lines of the evidence along three axes at right angles.
struct ManhattanFit {
  SO3 R_cam_axes;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< about a perturbation on the right
  std::vector<int> axis;                                  ///< per line: 0, 1, 2 or -1
  std::array<int, 3> lines{};
  std::array<double, 3> evidence{};  ///< of each axis [nats]
  double cost = 0;                   ///< description length; that of no axis is zero [nats]
  double orthogonality_rad = 0;      ///< of the axes, as estimated
};

/// Refines axes over all lines that they win. Each axis may deviate from its right angle by an
/// amount of its own, which is integrated out: with H and g the information and gradient of the
/// axis's lines, what they say of the rotation is (I + s^2 H)^-1 H and (I + s^2 H)^-1 g. The
/// deviation s is either none or from half to twice `orthogonality_rad`, by the largest restricted
/// likelihood: three angles are too few to tell smaller ones from chance. `widen_rad` is added to
/// the lines' errors in the first rounds, where the start is not so near.
ManhattanFit fit_manhattan(const VanishingEvidence& evidence, const SO3& R_cam_axes,
                           double orthogonality_rad, double widen_rad, int rounds);

/// How the lines of one axis, by themselves, would turn it: offset across the axis and covariance.
struct AxisOffset {
  bool ok = false;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};
AxisOffset own_direction(const VanishingEvidence& evidence, const ManhattanFit& fit, int axis);

}  // namespace placegraph
