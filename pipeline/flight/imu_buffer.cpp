#include <placegraph/backend/inertial/state_layout.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/pipeline/flight/imu_buffer.h>

#include <algorithm>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Code = Outcome::Code;

/// The body's rotation R_from_to by the rates of the gyro less its bias.
SO3 integrated_rotation(const std::deque<ImuSample>& samples, std::int64_t from_ns,
                        std::int64_t to_ns, const Vector3d& gyro_bias) {
  SO3 R_from_now;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const ImuSample &a = samples[i], &b = samples[i + 1];
    const std::int64_t begin = std::max(a.stamp_ns, from_ns), end = std::min(b.stamp_ns, to_ns);
    if (end <= begin) continue;
    const double middle = seconds(a.stamp_ns, begin + (end - begin) / 2);
    const double share = middle / seconds(a.stamp_ns, b.stamp_ns);
    const Vector3d rate = (1 - share) * a.gyro_rad_s + share * b.gyro_rad_s - gyro_bias;
    R_from_now = R_from_now * SO3::exp(seconds(begin, end) * rate);
  }
  return R_from_now;
}

}  // namespace

ImuBuffer::ImuBuffer(const SO3& R_body_cam, double gyro_noise)
    : R_body_cam_(R_body_cam), gyro_noise_(gyro_noise) {}

Outcome ImuBuffer::add(const ImuSample& sample) {
  if (!sample.gyro_rad_s.allFinite() || !sample.accel_m_s2.allFinite())
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not finite");
  if (!samples_.empty() && sample.stamp_ns <= samples_.back().stamp_ns)
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not after the last one");
  samples_.push_back(sample);
  return Outcome::ok();
}

KnownRotation ImuBuffer::camera_rotation(std::int64_t from_ns, std::int64_t to_ns,
                                         const std::optional<BodyState>& state) const {
  const SO3 R_from_to = integrated_rotation(samples_, from_ns, to_ns,
                                            state ? state->gyro_bias : Vector3d(Vector3d::Zero()));
  const SO3 R_cam_body = R_body_cam_.inverse();
  const double dt = seconds(from_ns, to_ns);
  Matrix3d covariance = gyro_noise_ * gyro_noise_ * dt * Matrix3d::Identity();
  if (state) covariance += dt * dt * state->covariance.block<3, 3>(kGyroBias, kGyroBias);
  return {R_cam_body * R_from_to * R_cam_body.inverse(),
          R_cam_body.matrix() * covariance * R_cam_body.matrix().transpose()};
}

std::optional<Vector3d> ImuBuffer::mean_force_body() const {
  if (samples_.empty()) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  for (const ImuSample& sample : samples_) sum += sample.accel_m_s2;
  return sum / static_cast<double>(samples_.size());
}

bool ImuBuffer::reaches(std::int64_t stamp_ns, double max_age_s) const {
  return !samples_.empty() && seconds(samples_.back().stamp_ns, stamp_ns) <= max_age_s;
}

void ImuBuffer::forget_before(std::int64_t stamp_ns) {
  while (samples_.size() > 1 && samples_[1].stamp_ns <= stamp_ns) samples_.pop_front();
}

}  // namespace placegraph
