#include <fmt/format.h>
#include <placegraph/eval/offsets/offset_freedom.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

/// Share of a free direction with which a parameter takes part in it, and its value is unknown: a
/// metre along the direction moves it by a centimetre. Chosen.
constexpr double kMoved = 0.01;

/// A unit vector whose largest component is positive, without negative zeros.
Eigen::Vector3d unit_axis(const Eigen::Vector3d& vector) {
  Eigen::Index largest = 0;
  vector.cwiseAbs().maxCoeff(&largest);
  const Eigen::Vector3d axis = vector.normalized() * (vector[largest] < 0 ? -1 : 1);
  return (axis.array().abs() < 5e-3).select(Eigen::Vector3d::Zero(), axis);
}

std::string axis_text(const Eigen::Vector3d& axis) {
  return fmt::format("({:.2f} {:.2f} {:.2f})", axis[0], axis[1], axis[2]);
}

/// Orthonormal directions of three parameters that are free with all others held.
std::vector<Eigen::Vector3d> free_alone(const OffsetMatrix& information, int at,
                                        double bound) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(information.block<3, 3>(at, at)));
  std::vector<Eigen::Vector3d> found;
  for (int k = 0; k < 3; ++k)
    if (solver.eigenvalues()[k] < bound) found.push_back(solver.eigenvectors().col(k));
  return found;
}

/// Takes the part along a direction out of the columns.
void take_out(Eigen::MatrixXd& columns, const OffsetVector& direction) {
  columns -= direction * (direction.transpose() * columns).eval();
}

/// The names of the free directions of the lever arm; one for all three.
std::vector<FreeOffset> lever_arms(const std::vector<Eigen::Vector3d>& axes) {
  if (axes.size() == 3)
    return {FreeOffset{
        {0, 0, 0}, {0, 0, 0}, false, false, "the lever arm is free: the body does not turn"}};
  std::vector<FreeOffset> named;
  for (const Eigen::Vector3d& axis : axes) {
    FreeOffset free;
    free.lever_arm = unit_axis(axis);
    free.text = fmt::format("the lever arm along {} is free: the body turns about that axis alone",
                            axis_text(free.lever_arm));
    named.push_back(free);
  }
  return named;
}

/// The names of the free directions of the rotation; one for all three.
std::vector<FreeOffset> rotations(const std::vector<Eigen::Vector3d>& axes) {
  if (axes.size() == 3)
    return {FreeOffset{
        {0, 0, 0}, {0, 0, 0}, false, false, "the rotation of the body is free: it stands still"}};
  std::vector<FreeOffset> named;
  for (const Eigen::Vector3d& axis : axes) {
    FreeOffset free;
    free.rotation = unit_axis(axis);
    free.text = fmt::format(
        "the rotation about {} is free: the body moves along that axis and turns about no other",
        axis_text(free.rotation));
    named.push_back(free);
  }
  return named;
}

/// What is free together, of columns in the axes of the estimate's body.
FreeOffset together(const OffsetVector& direction) {
  FreeOffset free;
  std::string what;
  const auto add = [&](const std::string& part) {
    what += (what.empty() ? "" : " together with ") + part;
  };
  if (direction.head<3>().norm() > kMoved) {
    free.lever_arm = unit_axis(direction.head<3>());
    add("the lever arm along " + axis_text(free.lever_arm));
  }
  if (direction.segment<3>(kRotationAt).norm() > kMoved) {
    free.rotation = unit_axis(direction.segment<3>(kRotationAt));
    add("the rotation about " + axis_text(free.rotation));
  }
  free.time = std::abs(direction[kTimeAt]) > kMoved;
  if (free.time) add("the time");
  free.scale = std::abs(direction[kScaleAt]) > kMoved;
  if (free.scale) add("the scale");
  free.text = what + " is free: every motion that the trajectories make looks the same with it";
  return free;
}

}  // namespace

OffsetMatrix to_estimate_axes(const OffsetFit& fit, bool has_rotation) {
  OffsetMatrix turn = OffsetMatrix::Identity();
  if (!has_rotation) return turn;
  const Eigen::Matrix3d R_estimate_truth = fit.state.T_estimate_truth.rotation().matrix();
  turn.block<3, 3>(kLeverAt, kLeverAt) = R_estimate_truth;
  turn.block<3, 3>(kRotationAt, kRotationAt) = R_estimate_truth;
  return turn;
}

OffsetVector moved_by_free(const OffsetFit& fit, const OffsetMatrix& turn) {
  OffsetVector moved = OffsetVector::Zero();
  const Eigen::MatrixXd free = turn * fit.free;
  for (int k = 0; k < kOffsetParameters; ++k)
    if (free.row(k).norm() > kMoved) moved[k] = std::numeric_limits<double>::infinity();
  return moved;
}

std::vector<FreeOffset> free_offsets(const OffsetFit& fit, const OffsetOptions& options,
                                     bool has_rotation) {
  const OffsetMatrix turn = to_estimate_axes(fit, has_rotation);
  const OffsetMatrix information = turn * fit.information * turn.transpose();
  const double bound = least_shown(!has_rotation);
  Eigen::MatrixXd rest = turn * fit.free;
  std::vector<FreeOffset> found;
  const auto take = [&](const std::vector<Eigen::Vector3d>& axes, int at,
                        const std::vector<FreeOffset>& named) {
    for (const Eigen::Vector3d& axis : axes) {
      OffsetVector direction = OffsetVector::Zero();
      direction.segment<3>(at) = axis;
      take_out(rest, direction);
    }
    found.insert(found.end(), named.begin(), named.end());
  };
  const std::vector<Eigen::Vector3d> levers = free_alone(information, kLeverAt, bound);
  if (options.body) take(levers, kLeverAt, lever_arms(levers));
  const std::vector<Eigen::Vector3d> turns = free_alone(information, kRotationAt, bound);
  // Of positions alone it is a rotation of the worlds that nobody asks for.
  if (!has_rotation) take(turns, kRotationAt, {});
  if (has_rotation && options.body) take(turns, kRotationAt, rotations(turns));
  if (options.time && information(kTimeAt, kTimeAt) < bound) {
    FreeOffset free;
    free.time = true;
    free.text =
        "the time offset is free: the velocity in the body's frame is constant, and a later time "
        "looks like a place further along the path";
    if (!options.body) free.text += "; or the bodies differ, which body,time estimates, too";
    found.push_back(free);
    take_out(rest, OffsetVector::Unit(kTimeAt));
  }
  for (int k = 0; k < rest.cols(); ++k) {
    // What is left of a free direction that has been named is small.
    if (rest.col(k).norm() < 0.5) continue;
    const OffsetVector direction = rest.col(k).normalized();
    take_out(rest, direction);
    const FreeOffset free = together(direction);
    const bool asked = free.time || (has_rotation && options.body) || free.lever_arm.norm() > 0;
    if (asked) found.push_back(free);
  }
  return found;
}

}  // namespace placegraph
