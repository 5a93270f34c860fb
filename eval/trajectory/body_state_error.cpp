#include <placegraph/eval/trajectory/body_state_error.h>
#include <placegraph/graph/core/time.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Vector15d = Eigen::Matrix<double, 15, 1>;

/// Squared error over its degrees of freedom normalized by the covariance; nothing if that is not
/// positive definite.
std::optional<double> normalized(const BodyState& state, const Vector15d& error, int at, int size) {
  const Eigen::MatrixXd P = state.covariance.block(at, at, size, size);
  const Eigen::LLT<Eigen::MatrixXd> llt(P);
  if (llt.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd e = error.segment(at, size);
  return e.dot(llt.solve(e)) / size;
}

}  // namespace

std::optional<BodyState> interpolate(const std::vector<BodyState>& recording, std::int64_t stamp_ns,
                                     double max_gap_s) {
  const auto after = std::lower_bound(
      recording.begin(), recording.end(), stamp_ns,
      [](const BodyState& state, std::int64_t stamp) { return state.stamp_ns < stamp; });
  if (after == recording.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return *after;
  if (after == recording.begin()) return std::nullopt;
  const BodyState &a = *(after - 1), &b = *after;
  const double gap_s = seconds(a.stamp_ns, b.stamp_ns);
  if (gap_s > max_gap_s) return std::nullopt;
  const double t = seconds(a.stamp_ns, stamp_ns) / gap_s;
  const auto between = [t](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return Eigen::Vector3d((1 - t) * from + t * to);
  };
  BodyState state;
  state.stamp_ns = stamp_ns;
  const SO3 &R_a = a.T_world_body.rotation(), &R_b = b.T_world_body.rotation();
  state.T_world_body = SE3(R_a.plus(t * (R_a.inverse() * R_b).log()),
                           between(a.T_world_body.translation(), b.T_world_body.translation()));
  state.velocity_world = between(a.velocity_world, b.velocity_world);
  state.gyro_bias = between(a.gyro_bias, b.gyro_bias);
  state.accel_bias = between(a.accel_bias, b.accel_bias);
  return state;
}

Vector15d error_of(const BodyState& truth, const BodyState& estimated) {
  Vector15d error;
  error << truth.T_world_body.translation() - estimated.T_world_body.translation(),
      truth.velocity_world - estimated.velocity_world,
      (estimated.T_world_body.rotation().inverse() * truth.T_world_body.rotation()).log(),
      truth.gyro_bias - estimated.gyro_bias, truth.accel_bias - estimated.accel_bias;
  return error;
}

BodyStateError body_state_error(const std::vector<BodyState>& truth,
                                const std::vector<BodyState>& estimated) {
  BodyStateError result;
  Vector15d squares = Vector15d::Zero();
  int judged = 0;
  std::int64_t first_ns = 0, last_ns = 0;
  for (const BodyState& state : estimated) {
    const auto is = interpolate(truth, state.stamp_ns);
    if (!is) continue;
    const Vector15d error = error_of(*is, state);
    squares += error.cwiseAbs2();
    result.end_error_m = error.head<3>().norm();
    result.position_max_m = std::max(result.position_max_m, result.end_error_m);
    if (result.compared++ == 0) first_ns = state.stamp_ns;
    last_ns = state.stamp_ns;
    const auto all = normalized(state, error, 0, 15);
    if (!all) continue;
    ++judged;
    result.anees += *all;
    result.anees_position += *normalized(state, error, 0, 3);
    result.anees_velocity += *normalized(state, error, 3, 3);
    result.anees_attitude += *normalized(state, error, 6, 3);
  }
  if (result.compared == 0) {
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData, "no state at a time of the ground truth");
    return result;
  }
  const double n = result.compared;
  result.position_rmse_m = std::sqrt(squares.segment<3>(0).sum() / n);
  result.velocity_rmse_mps = std::sqrt(squares.segment<3>(3).sum() / n);
  result.attitude_rmse_rad = std::sqrt(squares.segment<3>(6).sum() / n);
  for (double* mean :
       {&result.anees, &result.anees_position, &result.anees_velocity, &result.anees_attitude})
    *mean = judged > 0 ? *mean / judged : std::nan("");
  for (std::size_t i = 1; i < truth.size(); ++i)
    if (truth[i - 1].stamp_ns >= first_ns && truth[i].stamp_ns <= last_ns)
      result.path_length_m +=
          (truth[i].T_world_body.translation() - truth[i - 1].T_world_body.translation()).norm();
  result.outcome =
      judged == result.compared
          ? Outcome::ok()
          : Outcome::failure(Outcome::Code::kDegenerate, "a covariance is not positive definite");
  return result;
}

}  // namespace placegraph
