#include <placegraph/backend/inertial/covariance_matrix.h>
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/backend/inertial/state_layout.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Code = Outcome::Code;

Outcome not_started() {
  return Outcome::failure(Code::kNotAttempted, "the filter has not been started");
}

}  // namespace

ErrorStateFilter::ErrorStateFilter(const ErrorStateFilterOptions& options, const SE3& T_body_cam,
                                   double floor_z_m)
    : options_(options), T_body_cam_(T_body_cam), floor_z_m_(floor_z_m) {
  options_.check();
}

void ErrorStateFilter::start(const BodyState& state) {
  require(state.T_world_body.translation().allFinite() && state.velocity_world.allFinite() &&
              state.gyro_bias.allFinite() && state.accel_bias.allFinite() &&
              state.covariance.allFinite(),
          "ErrorStateFilter: the initial state is not finite");
  events_.clear();
  Event first;
  first.stamp_ns = state.stamp_ns;
  first.after = state;
  // The body is assumed at rest until the first inertial sample.
  first.imu_assumed = true;
  first.imu.stamp_ns = state.stamp_ns;
  first.imu.gyro_rad_s = state.gyro_bias;
  first.imu.accel_m_s2 =
      state.T_world_body.rotation().inverse() * Vector3d(-gravity()) + state.accel_bias;
  events_.push_back(first);
}

/// One step of the strapdown equations, with the transition and the noise of the error.
BodyState ErrorStateFilter::predict(const Event& from, std::int64_t to_ns,
                                    const ImuSample& imu) const {
  BodyState state = from.after;
  const double dt = seconds(from.stamp_ns, to_ns);
  state.stamp_ns = to_ns;
  if (dt <= 0) return state;
  const Vector3d step_rotation = (imu.gyro_rad_s - state.gyro_bias) * dt;
  const Vector3d force = imu.accel_m_s2 - state.accel_bias;
  const SO3 R_begin = state.T_world_body.rotation();
  // The specific force is constant in the body frame; it is rotated by the attitude at mid-step.
  const Matrix3d R = (R_begin * SO3::exp(0.5 * step_rotation)).matrix();
  const Vector3d accel = R * force + gravity();
  state.T_world_body = SE3(R_begin * SO3::exp(step_rotation),
                           Vector3d(state.T_world_body.translation() + dt * state.velocity_world +
                                    0.5 * dt * dt * accel));
  state.velocity_world += dt * accel;

  Covariance F = Covariance::Identity();
  const Matrix3d force_by_attitude = -R * hat(force);
  F.block<3, 3>(kPosition, kVelocity) = dt * Matrix3d::Identity();
  F.block<3, 3>(kPosition, kAttitude) = 0.5 * dt * dt * force_by_attitude;
  F.block<3, 3>(kPosition, kAccelBias) = -0.5 * dt * dt * R;
  F.block<3, 3>(kVelocity, kAttitude) = dt * force_by_attitude;
  F.block<3, 3>(kVelocity, kAccelBias) = -dt * R;
  F.block<3, 3>(kAttitude, kAttitude) = SO3::exp(-step_rotation).matrix();
  F.block<3, 3>(kAttitude, kGyroBias) = -dt * SO3::right_jacobian(step_rotation);
  F.block<3, 3>(kVelocity, kGyroBias) = 0.5 * dt * force_by_attitude * -dt;
  Covariance Q = Covariance::Zero();
  const auto add = [&](int at, double density) {
    Q.block<3, 3>(at, at) += density * density * dt * Matrix3d::Identity();
  };
  add(kVelocity, options_.accel_noise);
  add(kAttitude, options_.gyro_noise);
  add(kGyroBias, options_.gyro_bias_walk);
  add(kAccelBias, options_.accel_bias_walk);
  const double accel_variance = options_.accel_noise * options_.accel_noise;
  Q.block<3, 3>(kPosition, kPosition) += accel_variance * dt * dt * dt / 3 * Matrix3d::Identity();
  Q.block<3, 3>(kPosition, kVelocity) += accel_variance * dt * dt / 2 * Matrix3d::Identity();
  Q.block<3, 3>(kVelocity, kPosition) += accel_variance * dt * dt / 2 * Matrix3d::Identity();
  state.covariance = F * state.covariance * F.transpose() + Q;
  return state;
}

/// Empty if the state does not predict the measurement: the camera is below the floor.
std::optional<ErrorStateFilter::Innovation> ErrorStateFilter::innovation(
    const BodyState& state, const ImuSample& imu, const Measurement& measurement) const {
  Innovation result;
  const Matrix3d R = state.T_world_body.rotation().matrix();
  if (const auto* pose = std::get_if<PoseMeasurement>(&measurement)) {
    result.residual = (state.T_world_body.inverse() * pose->T_world_body).log();
    result.H = MatrixXd::Zero(6, 15);
    result.H.block<3, 3>(0, kPosition) = R.transpose();
    result.H.block<3, 3>(3, kAttitude) = Matrix3d::Identity();
    result.R = pose->covariance;
    return result;
  }
  const auto* flow = std::get_if<FlowMeasurement>(&measurement);
  if (!flow) return std::nullopt;
  // The camera's velocity over its height, for the time between the images.
  const double dt = seconds(flow->from_ns, flow->to_ns);
  const Vector3d arm = T_body_cam_.translation();
  const Matrix3d R_cam_body = T_body_cam_.rotation().matrix().transpose();
  const Vector3d rate = imu.gyro_rad_s - state.gyro_bias;
  const Vector3d v_body = R.transpose() * state.velocity_world;
  const Vector3d v_cam = R_cam_body * (v_body + rate.cross(arm));
  const Vector3d up_by_attitude = -(R * hat(arm)).row(2).transpose();
  // The height at the first image, half the interval earlier.
  const double height = (state.T_world_body * arm).z() - floor_z_m_ -
                        0.5 * dt * (state.velocity_world + R * rate.cross(arm)).z();
  // Keeps the quotient finite. Chosen.
  constexpr double kLeastHeight_m = 0.01;
  if (!(height > kLeastHeight_m) || !(dt > 0)) return std::nullopt;
  const double share = dt / height;
  // The axes of the flow are those of the camera at the first image, half a step before the state.
  const Matrix3d R_first_middle = SO3::exp(R_cam_body * Vector3d(0.5 * dt * rate)).matrix();
  const Vector3d expected = share * R_first_middle * v_cam;
  result.residual = flow->over_distance - expected;
  result.H = MatrixXd::Zero(3, 15);
  const Matrix3d to_flow = share * R_first_middle * R_cam_body;
  result.H.block<3, 3>(0, kVelocity) = to_flow * R.transpose();
  result.H.block<3, 3>(0, kAttitude) = to_flow * hat(v_body);
  result.H.block<3, 3>(0, kGyroBias) = to_flow * hat(arm);
  const Vector3d by_height = -expected / height;
  result.H.col(kPosition + 2) += by_height;
  result.H.block<3, 3>(0, kAttitude) += by_height * up_by_attitude.transpose();
  result.H.col(kVelocity + 2) -= by_height * 0.5 * dt;
  result.R = flow->covariance;
  if (flow->J_rotation) {
    // Noise and bias of the gyroscope affect this rotation and the attitude with opposite signs.
    const Matrix3d J = *flow->J_rotation * R_cam_body;
    // Corrects the rotation with the current estimate of the bias.
    result.residual -= dt * J * (state.gyro_bias - flow->gyro_bias);
    const double variance = options_.gyro_noise * options_.gyro_noise * dt;
    result.H.block<3, 3>(0, kGyroBias) += dt * J;
    result.R += variance * J * J.transpose();
    result.C = MatrixXd::Zero(15, 3);
    result.C.block<3, 3>(kAttitude, 0) = -variance * J.transpose();
  }
  return result;
}

/// False if the measurement is outside the gate; then the state is unchanged.
bool ErrorStateFilter::correct(const Innovation& innovation, BodyState& state) const {
  const MatrixXd& H = innovation.H;
  MatrixXd PHt = state.covariance * H.transpose();
  MatrixXd S = H * PHt + innovation.R;
  const bool correlated = innovation.C.size() > 0;
  if (correlated) {
    const MatrixXd HC = H * innovation.C;
    S += HC + HC.transpose();
    PHt += innovation.C;
  }
  const Eigen::LDLT<MatrixXd> solver(S);
  const double chi2 = innovation.residual.dot(solver.solve(innovation.residual));
  const double limit =
      chi_squared_quantile(options_.gate, static_cast<int>(innovation.residual.size()));
  if (!(chi2 <= limit)) return false;
  const MatrixXd K = solver.solve(PHt.transpose()).transpose();
  const VectorXd step = K * innovation.residual;
  state.T_world_body = SE3(state.T_world_body.rotation() * SO3::exp(step.segment<3>(kAttitude)),
                           Vector3d(state.T_world_body.translation() + step.segment<3>(kPosition)));
  state.velocity_world += step.segment<3>(kVelocity);
  state.gyro_bias += step.segment<3>(kGyroBias);
  state.accel_bias += step.segment<3>(kAccelBias);
  // Joseph's form keeps the covariance positive; G refers the attitude's error to the new attitude.
  const Covariance I_KH = Covariance::Identity() - K * H;
  state.covariance = I_KH * state.covariance * I_KH.transpose() + K * innovation.R * K.transpose();
  if (correlated) {
    const MatrixXd cross = I_KH * innovation.C * K.transpose();
    state.covariance -= cross + cross.transpose();
  }
  Covariance G = Covariance::Identity();
  G.block<3, 3>(kAttitude, kAttitude) =
      Matrix3d::Identity() - hat(Vector3d(0.5 * step.segment<3>(kAttitude)));
  state.covariance = G * state.covariance * G.transpose();
  return true;
}

/// Repeats the predictions and corrections from event `from` on.
void ErrorStateFilter::replay(std::size_t from) {
  for (std::size_t i = from; i < events_.size(); ++i) {
    Event& event = events_[i];
    const Event& before = events_[i - 1];
    event.imu = before.imu;
    event.imu_assumed = before.imu_assumed;
    if (const auto* sample = std::get_if<ImuSample>(&event.measurement)) {
      // The mean of two successive samples, except across a gap.
      ImuSample mean = *sample;
      // A gap in the samples. Chosen.
      constexpr double kSkipped_s = 0.1;
      if (!before.imu_assumed && seconds(before.imu.stamp_ns, sample->stamp_ns) < kSkipped_s) {
        mean.gyro_rad_s = 0.5 * (before.imu.gyro_rad_s + sample->gyro_rad_s);
        mean.accel_m_s2 = 0.5 * (before.imu.accel_m_s2 + sample->accel_m_s2);
      }
      event.after = predict(before, event.stamp_ns, mean);
      event.imu = *sample;
      event.imu_assumed = false;
      continue;
    }
    event.after = predict(before, event.stamp_ns, before.imu);
    const auto found = innovation(event.after, event.imu, event.measurement);
    event.accepted = found && correct(*found, event.after);
  }
}

void ErrorStateFilter::forget() {
  const std::int64_t newest = events_.back().stamp_ns;
  while (events_.size() > 1 && seconds(events_[1].stamp_ns, newest) > options_.history_s)
    events_.pop_front();
}

Outcome ErrorStateFilter::insert(std::int64_t stamp_ns, const Measurement& measurement) {
  if (events_.empty()) return not_started();
  if (stamp_ns < events_.front().stamp_ns)
    return Outcome::failure(Code::kTooFewData, "the measurement is older than the history");
  if (seconds(events_.back().imu.stamp_ns, stamp_ns) > options_.max_prediction_s)
    return Outcome::failure(Code::kTooFewData, "no inertial samples reach to the measurement");
  const auto at = std::upper_bound(
      events_.begin(), events_.end(), stamp_ns,
      [](std::int64_t stamp, const Event& event) { return stamp < event.stamp_ns; });
  const auto index = static_cast<std::size_t>(at - events_.begin());
  Event event;
  event.stamp_ns = stamp_ns;
  event.measurement = measurement;
  events_.insert(at, event);
  replay(index);
  const bool accepted = events_[index].accepted;
  forget();
  return accepted ? Outcome::ok()
                  : Outcome::failure(Code::kInconsistent, "the measurement is outside the gate");
}

Outcome ErrorStateFilter::add(const ImuSample& sample) {
  if (events_.empty()) return not_started();
  if (!sample.gyro_rad_s.allFinite() || !sample.accel_m_s2.allFinite())
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not finite");
  if (sample.stamp_ns <= events_.back().imu.stamp_ns)
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not after the last one");
  Event event;
  event.stamp_ns = sample.stamp_ns;
  event.measurement = sample;
  const auto at = std::upper_bound(
      events_.begin(), events_.end(), sample.stamp_ns,
      [](std::int64_t stamp, const Event& other) { return stamp < other.stamp_ns; });
  const auto index = static_cast<std::size_t>(at - events_.begin());
  events_.insert(at, event);
  replay(index);
  forget();
  return Outcome::ok();
}

Outcome ErrorStateFilter::add(const PoseMeasurement& observation) {
  if (!observation.T_world_body.translation().allFinite() ||
      !positive_definite(observation.covariance))
    return Outcome::failure(Code::kInconsistent, "the pose or its covariance is unusable");
  return insert(observation.stamp_ns, observation);
}

Outcome ErrorStateFilter::add(const FlowMeasurement& observation) {
  if (!observation.over_distance.allFinite() || !positive_definite(observation.covariance) ||
      observation.to_ns <= observation.from_ns)
    return Outcome::failure(Code::kInconsistent, "the flow or its covariance is unusable");
  return insert(observation.from_ns + (observation.to_ns - observation.from_ns) / 2, observation);
}

std::optional<double> ErrorStateFilter::deviation2(const PoseMeasurement& observation) const {
  const StateEstimate expected = at(observation.stamp_ns);
  if (!expected.outcome) return std::nullopt;
  const auto found = innovation(expected.state, {}, observation);
  const MatrixXd S = found->H * expected.state.covariance * found->H.transpose() + found->R;
  return found->residual.dot(S.ldlt().solve(found->residual));
}

BodyExpectation ErrorStateFilter::expectation(std::int64_t stamp_ns) const {
  BodyExpectation expected;
  if (const StateEstimate estimate = at(stamp_ns); estimate.outcome)
    expected.state = estimate.state;
  expected.deviation2 = [this](const PoseMeasurement& observation) {
    return deviation2(observation);
  };
  return expected;
}

ErrorStateFilter::StateEstimate ErrorStateFilter::at(std::int64_t stamp_ns) const {
  StateEstimate estimate;
  if (events_.empty()) {
    estimate.outcome = not_started();
    return estimate;
  }
  const auto after = std::upper_bound(
      events_.begin(), events_.end(), stamp_ns,
      [](std::int64_t stamp, const Event& event) { return stamp < event.stamp_ns; });
  if (after == events_.begin()) {
    estimate.outcome = Outcome::failure(Code::kTooFewData, "the time is before the history");
    return estimate;
  }
  const Event& last = *(after - 1);
  estimate.state = predict(last, stamp_ns, last.imu);
  // The last sample is extrapolated as constant; its unknown change is the same over the whole
  // time.
  const double ahead = std::max(0.0, seconds(last.imu.stamp_ns, stamp_ns));
  Eigen::Matrix<double, 15, 3> unknown_rotation = Eigen::Matrix<double, 15, 3>::Zero();
  Eigen::Matrix<double, 15, 3> unknown_push = unknown_rotation;
  unknown_rotation.block<3, 3>(kAttitude, 0)
      .diagonal()
      .setConstant(0.5 * ahead * ahead * options_.ahead_rotation_rad_s2);
  unknown_push.block<3, 3>(kVelocity, 0)
      .diagonal()
      .setConstant(0.5 * ahead * ahead * options_.ahead_push_m_s3);
  unknown_push.block<3, 3>(kPosition, 0)
      .diagonal()
      .setConstant(ahead * ahead * ahead / 6 * options_.ahead_push_m_s3);
  estimate.state.covariance +=
      unknown_rotation * unknown_rotation.transpose() + unknown_push * unknown_push.transpose();
  if (seconds(last.imu.stamp_ns, stamp_ns) > options_.max_prediction_s) {
    estimate.outcome = Outcome::failure(
        Code::kTooFewData, "the last inertial sample is " +
                               std::to_string(seconds(last.imu.stamp_ns, stamp_ns)) + " s old");
    return estimate;
  }
  const double variance = estimate.state.covariance.topLeftCorner<3, 3>().diagonal().maxCoeff();
  estimate.outcome =
      std::sqrt(variance) > options_.max_position_sigma_m
          ? Outcome::failure(Code::kDegenerate, "the standard deviation of the position is " +
                                                    std::to_string(std::sqrt(variance)) + " m")
          : Outcome::ok();
  return estimate;
}

}  // namespace placegraph
