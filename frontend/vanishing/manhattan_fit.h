#pragma once
#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/graph/geometry/so3.h>

#include <array>
#include <vector>

namespace placegraph {

/// Lines of the evidence along three orthogonal axes.
struct ManhattanFit {
  SO3 R_cam_axes;
  /// Information about a perturbation on the right.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  std::vector<int> axis;  ///< axis of each line: 0, 1, 2 or -1
  std::array<int, 3> lines{};
  std::array<double, 3> evidence{};  ///< evidence of each axis [nats]
  double cost = 0;                   ///< description length; without any axis it is zero [nats]
  double orthogonality_rad = 0;      ///< estimated deviation of the axes from right angles
};

/// Refines axes over all lines that they win.
///
/// Each axis may deviate from its right angle by an amount of its own, which is integrated out:
/// with H and g the information and gradient of the axis's lines, their contributions to the
/// rotation are (I + s^2 H)^-1 H and (I + s^2 H)^-1 g. The deviation s is either zero or from half
/// to twice `orthogonality_rad`, by the largest restricted likelihood: three angles are too few to
/// distinguish smaller ones from chance. `widen_rad` is added to the lines' errors in the first
/// rounds, in which the initial axes are less accurate.
ManhattanFit fit_manhattan(const VanishingEvidence& evidence, const SO3& R_cam_axes,
                           double orthogonality_rad, double widen_rad, int rounds);

/// Direction of one axis from its own lines: offset across the axis and covariance.
struct AxisOffset {
  bool ok = false;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};
AxisOffset own_direction(const VanishingEvidence& evidence, const ManhattanFit& fit, int axis);

}  // namespace placegraph
