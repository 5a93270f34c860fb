#include <fmt/format.h>
#include <placegraph/eval/alignment/vertical.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace placegraph {
namespace {

// A direction counts as evident if it has this many times the power of the next one: twice the
// amplitude. Chosen.
constexpr double kEvident = 4;
// A body that turns less than this in all shows no axis: rad^2, five degrees. Chosen.
constexpr double kLeastTurn_rad2 = 0.0076;
constexpr double kSnap_rad = 0.1745;  // ten degrees

/// Sum of w w^T over the rotations w from frame to frame, in the world.
Eigen::Matrix3d rotation_power(const std::vector<FramePair>& pairs) {
  Eigen::Matrix3d power = Eigen::Matrix3d::Zero();
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::Matrix3d& R = pairs[i - 1].T_world_truth.linear();
    const Eigen::Matrix3d step = pairs[i].T_world_truth.linear() * R.inverse();
    const Eigen::Vector3d axis(step(2, 1) - step(1, 2), step(0, 2) - step(2, 0),
                               step(1, 0) - step(0, 1));
    if (axis.norm() > 0) {
      const Eigen::Vector3d w = axis.normalized() * rotation_angle(step);
      power += w * w.transpose();
    }
  }
  return power;
}

Eigen::Vector3d unit(int axis) { return Eigen::Vector3d::Unit(axis); }

}  // namespace

PositionSpread spread_of(const std::vector<Eigen::Vector3d>& positions_m) {
  PositionSpread spread;
  if (positions_m.empty()) return spread;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : positions_m) mean += p;
  mean /= static_cast<double>(positions_m.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : positions_m) covariance += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      covariance / static_cast<double>(positions_m.size()));
  spread.axes = solver.eigenvectors();
  spread.variances_m2 = solver.eigenvalues().cwiseMax(0.0);
  return spread;
}

std::string axis_name(const Eigen::Vector3d& direction) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) >= std::cos(kSnap_rad)) return std::string(1, "xyz"[axis]);
  return {};
}

VerticalResult vertical_of(const std::vector<FramePair>& pairs, bool has_orientation,
                           Vertical choice) {
  VerticalResult result;
  result.outcome = Outcome::ok();
  if (choice != Vertical::kEstimated) {
    const int axis = static_cast<int>(choice) - static_cast<int>(Vertical::kX);
    result.axis = unit(axis);
    result.text = std::string(1, "xyz"[axis]);
    return result;
  }
  bool found = false;
  if (has_orientation) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> turns(rotation_power(pairs));
    const Eigen::Vector3d power = turns.eigenvalues();
    result.axis = turns.eigenvectors().col(2);
    found = power[2] >= kEvident * power[1] && power[2] >= kLeastTurn_rad2;
  }
  if (!found) {
    std::vector<Eigen::Vector3d> positions;
    for (const FramePair& pair : pairs) positions.push_back(pair.T_world_truth.translation());
    const PositionSpread spread = spread_of(positions);
    result.axis = spread.axes.col(0);
    found = spread.variances_m2[1] > 0 &&
            spread.variances_m2[1] >= kEvident * kEvident * spread.variances_m2[0];
  }
  if (!found) {
    result.outcome = Outcome::failure(
        Outcome::Code::kDegenerate,
        "no vertical is evident: the ground truth neither turns about one axis nor lies in a plane "
        "(name it: --vertical x, y or z)");
    return result;
  }
  Eigen::Index largest = 0;
  result.axis.cwiseAbs().maxCoeff(&largest);
  if (result.axis[largest] < 0) result.axis = -result.axis;
  const std::string name = axis_name(result.axis);
  if (!name.empty()) {
    result.axis = unit(name[0] - 'x');
    result.text = name + " (estimated)";
  } else {
    result.text = fmt::format("({:.3f}, {:.3f}, {:.3f}) (estimated)", result.axis[0],
                              result.axis[1], result.axis[2]);
  }
  return result;
}

}  // namespace placegraph
