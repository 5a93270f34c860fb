#include <placegraph/eval/offsets/offset_equations.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Share of a motion's duration over which the truth's velocity is taken, either way. Chosen.
constexpr double kVelocityShare = 1. / 4;

Vector6d scaled_twist(const Vector6d& twist, double scale) {
  Vector6d out = twist;
  out.head<3>() *= scale;
  return out;
}

/// Derivative of the translation of a motion in its end's frame, by the logarithm of the scale.
Vector6d by_scale(const SE3& motion) {
  Vector6d out = Vector6d::Zero();
  out.head<3>() = motion.rotation().inverse() * motion.translation();
  return out;
}

}  // namespace

OffsetState OffsetState::plus(const OffsetVector& change, bool positions_alone) const {
  OffsetState next = *this;
  if (positions_alone) {
    next.T_estimate_truth =
        SE3(T_estimate_truth.rotation(), T_estimate_truth.translation() + change.head<3>());
    next.R_world_estimate = R_world_estimate.plus(change.segment<3>(kRotationAt));
  } else {
    next.T_estimate_truth = T_estimate_truth.plus(change.head<6>());
  }
  next.time_s += change[kTimeAt];
  next.scale *= std::exp(change[kScaleAt]);
  return next;
}

OffsetEquations::OffsetEquations(const PosedPath& truth, const PosedPath& estimate,
                                 bool positions_alone, bool with_time)
    : truth_(truth),
      estimate_(estimate),
      nodes_(truth.spacing() > estimate.spacing() ? &truth : &estimate),
      positions_alone_(positions_alone),
      with_time_(with_time),
      span_(std::min(truth.times().back(), estimate.times().back()) -
            std::max(truth.times().front(), estimate.times().front())) {}

double OffsetEquations::half_of(double duration) const {
  return std::max(spacing(), kVelocityShare * duration);
}

std::optional<OffsetEquations::Node> OffsetEquations::node(std::size_t i, const OffsetState& state,
                                                           double duration) const {
  Node node;
  const double at = nodes_->times()[i];
  const double truth_at = nodes_ == &truth_ ? at : at + state.time_s;
  const double estimate_at = nodes_ == &estimate_ ? at : at - state.time_s;
  const std::optional<SE3> truth = truth_.at(truth_at), estimate = estimate_.at(estimate_at);
  if (!truth || !estimate) return std::nullopt;
  node.time = at;
  node.T_world_truth = *truth;
  node.T_world_estimate = *estimate;
  if (!with_time_) return node;
  const auto truth_twist = truth_.twist(truth_at, half_of(duration));
  // Of poses the true derivative; of positions it is the instrument, too, and should be smooth.
  const double half = positions_alone_ ? half_of(duration) : spacing();
  const auto estimate_twist = estimate_.twist(estimate_at, half);
  if (!truth_twist || !estimate_twist) return std::nullopt;
  node.truth_twist = *truth_twist;
  node.estimate_twist = *estimate_twist;
  return node;
}

OffsetRow OffsetEquations::pose_row(const Node& i, const Node& j, const OffsetState& state) const {
  const SE3& X = state.T_estimate_truth;
  const SE3 X_inverse = X.inverse();
  const SE3 of_truth = i.T_world_truth.inverse() * j.T_world_truth;
  const SE3 of_estimate =
      (i.T_world_estimate.inverse() * j.T_world_estimate).scaled(state.scale);
  const SE3 predicted = X_inverse * of_estimate * X;
  const SE3 off = predicted.inverse() * of_truth;
  OffsetRow row;
  row.time = i.time;
  row.error << off.translation(), off.rotation().log();

  const Matrix6d to_truth = X_inverse.adjoint();
  row.derivative.leftCols<6>() = Matrix6d::Identity() - predicted.inverse().adjoint();
  row.derivative.col(kTimeAt) =
      -to_truth * (scaled_twist(j.estimate_twist, state.scale) -
                   of_estimate.inverse().adjoint() * scaled_twist(i.estimate_twist, state.scale));
  row.derivative.col(kScaleAt) = to_truth * by_scale(of_estimate);

  const Matrix6d back = of_truth.inverse().adjoint();
  row.instrument.leftCols<6>() = Matrix6d::Identity() - back;
  row.instrument.col(kTimeAt) = back * i.truth_twist - j.truth_twist;
  row.instrument.col(kScaleAt) = to_truth * by_scale(X * of_truth * X_inverse);
  return row;
}

OffsetRow OffsetEquations::position_row(const Node& i, const Node& j,
                                        const OffsetState& state) const {
  const Eigen::Vector3d& lever_m = state.T_estimate_truth.translation();
  const Eigen::Matrix3d R_i = i.T_world_estimate.rotation().matrix();
  const Eigen::Matrix3d R_j = j.T_world_estimate.rotation().matrix();
  const Eigen::Vector3d moved_m =
      state.scale * (j.T_world_estimate.translation() - i.T_world_estimate.translation());
  const Eigen::Matrix3d R = state.R_world_estimate.matrix();
  const Eigen::Vector3d predicted_m = moved_m + (R_j - R_i) * lever_m;
  // Velocity of the point that the truth observes, in the estimate's world.
  const auto velocity = [&](const Eigen::Matrix3d& R_world, const Vector6d& twist) {
    const Eigen::Vector3d own = state.scale * twist.head<3>() + twist.tail<3>().cross(lever_m);
    return Eigen::Vector3d(R_world * own);
  };
  OffsetRow row;
  row.time = i.time;
  row.error.setZero();
  row.error.head<3>() =
      j.T_world_truth.translation() - i.T_world_truth.translation() - R * predicted_m;
  row.derivative.setZero();
  row.derivative.block<3, 3>(0, kLeverAt) = R * (R_j - R_i);
  row.derivative.block<3, 3>(0, kRotationAt) = -R * hat(predicted_m);
  row.derivative.block<3, 1>(0, kTimeAt) =
      -R * (velocity(R_j, j.estimate_twist) - velocity(R_i, i.estimate_twist));
  row.derivative.block<3, 1>(0, kScaleAt) = R * moved_m;
  row.instrument = row.derivative;
  return row;
}

std::vector<OffsetEquations::Motion> OffsetEquations::motions(const OffsetState& state,
                                                              double duration, int most) const {
  const std::vector<double>& times = nodes_->times();
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  for (std::size_t i = 0, j = 0; i < times.size(); ++i) {
    const double end = times[i] + duration - 0.25 * spacing();
    while (j < times.size() && times[j] < end) ++j;
    // A longer one would begin before a gap.
    if (j < times.size() && times[j] <= times[i] + duration + spacing()) ends.emplace_back(i, j);
  }
  std::vector<std::optional<Node>> nodes(times.size());
  std::vector<bool> tried(times.size(), false);
  const auto node_at = [&](std::size_t i) -> const std::optional<Node>& {
    if (!tried[i]) nodes[i] = node(i, state, duration);
    tried[i] = true;
    return nodes[i];
  };
  const std::size_t stride = 1 + ends.size() / static_cast<std::size_t>(most);
  std::vector<Motion> found;
  for (std::size_t k = 0; k < ends.size(); k += stride) {
    const std::optional<Node>& begin = node_at(ends[k].first);
    const std::optional<Node>& end = node_at(ends[k].second);
    if (begin && end) found.emplace_back(*begin, *end);
  }
  return found;
}

std::vector<OffsetRow> OffsetEquations::rows(const OffsetState& state, double duration,
                                             int most) const {
  std::vector<OffsetRow> rows;
  for (const auto& [i, j] : motions(state, duration, most))
    rows.push_back(positions_alone_ ? position_row(i, j, state) : pose_row(i, j, state));
  return rows;
}

OffsetState OffsetEquations::aligned(const OffsetState& state, double duration, int most,
                                     bool with_scale) const {
  // Share of the identity among motions that all agree. Chosen.
  constexpr double kIdentity = 0.1;
  Eigen::Matrix3d translations = Eigen::Matrix3d::Zero(), rotations = Eigen::Matrix3d::Zero();
  double truth_m2 = 0, estimate_m2 = 0, truth_rad2 = 0, estimate_rad2 = 0;
  for (const auto& [i, j] : motions(state, duration, most)) {
    const SE3 truth = i.T_world_truth.inverse() * j.T_world_truth;
    const SE3 estimate = i.T_world_estimate.inverse() * j.T_world_estimate;
    Eigen::Vector3d a = estimate.translation(), b = truth.translation();
    if (positions_alone_) {
      a = i.T_world_estimate.rotation() * a;
      b = i.T_world_truth.rotation() * b;
    }
    translations += a * b.transpose();
    const Eigen::Vector3d from = estimate.rotation().log(), to = truth.rotation().log();
    rotations += from * to.transpose();
    truth_m2 += b.squaredNorm();
    estimate_m2 += a.squaredNorm();
    truth_rad2 += to.squaredNorm();
    estimate_rad2 += from.squaredNorm();
  }
  const auto share = [](const Eigen::Matrix3d& sum, double a, double b) {
    return Eigen::Matrix3d(sum * (a > 0 && b > 0 ? 1 / std::sqrt(a * b) : 0));
  };
  Eigen::Matrix3d M = share(translations, estimate_m2, truth_m2);
  if (!positions_alone_) M += share(rotations, estimate_rad2, truth_rad2);
  M += kIdentity * Eigen::Matrix3d::Identity();
  // The rotation that maximizes tr(R^T M): a = R b of every motion.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d R_estimate_truth =
      svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  OffsetState next = state;
  if (positions_alone_)
    next.R_world_estimate = SO3::from_matrix(R_estimate_truth.transpose());
  else
    next.T_estimate_truth =
        SE3(SO3::from_matrix(R_estimate_truth), state.T_estimate_truth.translation());
  if (with_scale && truth_m2 > 0 && estimate_m2 > 0) next.scale = std::sqrt(truth_m2 / estimate_m2);
  return next;
}

}  // namespace placegraph
