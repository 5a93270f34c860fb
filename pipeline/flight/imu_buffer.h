#pragma once
#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/imu.h>

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

namespace placegraph {

/// The inertial samples since an image, and the last one at or before it, for the rotation of the
/// camera between two images and the mean of the accelerometer.
class ImuBuffer {
 public:
  /// `gyro_noise` [rad / s / sqrt(Hz)] is the density of the gyro's white noise.
  ImuBuffer(const SO3& R_body_cam, double gyro_noise);

  /// Adds a sample. Outcomes: inconsistent (not finite, or not after the last sample); such a
  /// sample is not kept.
  Outcome add(const ImuSample& sample);
  /// The camera's rotation between two images (R_1_2). Angular rates are linear between samples;
  /// intervals without samples on both sides are treated as having no rotation. `state` is the body
  /// at the first image, if it is known: its gyro bias is subtracted, and the covariance of that
  /// bias is added to that of the gyro's noise.
  KnownRotation camera_rotation(std::int64_t from_ns, std::int64_t to_ns,
                                const std::optional<BodyState>& state) const;
  /// Mean specific force of all samples [m/s^2]; nothing if there is none.
  std::optional<Eigen::Vector3d> mean_force_body() const;
  /// Whether the newest sample is at most `max_age_s` older than a time.
  bool reaches(std::int64_t stamp_ns, double max_age_s) const;
  /// Drops all samples before the last one at or before `stamp_ns`.
  void forget_before(std::int64_t stamp_ns);

  /// Samples in the order of their stamps.
  const std::deque<ImuSample>& samples() const { return samples_; }

 private:
  SO3 R_body_cam_;
  double gyro_noise_;
  std::deque<ImuSample> samples_;
};

}  // namespace placegraph
