#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

namespace placegraph::test {

/// Sums of sines of random periods, amplitudes and phases: a motion that is smooth and known at any
/// time.
class SmoothMotion {
 public:
  /// Amplitudes of position [m] and rotation vector [rad] by axis; periods from 2 to 12 s.
  SmoothMotion(const Vector6d& amplitude, Random& random) {
    for (int axis = 0; axis < 6; ++axis)
      for (Wave& wave : waves_[static_cast<std::size_t>(axis)])
        wave = {amplitude[axis] * random.uniform(0.3, 1), 6.283 / random.uniform(2, 12),
                random.uniform(0, 6.283)};
  }
  SE3 operator()(double time_s) const {
    Vector6d x = Vector6d::Zero();
    for (int axis = 0; axis < 6; ++axis)
      for (const Wave& wave : waves_[static_cast<std::size_t>(axis)])
        x[axis] += wave.amplitude * std::sin(wave.rate * time_s + wave.phase);
    return SE3(SO3::exp(x.tail<3>()), Eigen::Vector3d(x.head<3>()));
  }

 private:
  struct Wave {
    double amplitude = 0, rate = 0, phase = 0;
  };
  std::array<std::array<Wave, 4>, 6> waves_;
};

/// Offsets, rates and noise of a made pair of trajectories.
struct OffsetWorld {
  std::function<SE3(double)> T_world_truth;  ///< motion of the truth's body, by its clock
  SE3 T_estimate_truth;                      ///< what is to be found
  double time_s = 0;                         ///< added to the estimate's stamps
  double scale = 1;                          ///< metres per unit of the estimate
  SE3 T_world_other;                         ///< the estimate's world in the truth's
  double duration_s = 60, truth_hz = 50, estimate_hz = 20;
  double truth_m = 0, truth_rad = 0;        ///< white noise of each true pose
  double estimate_m = 0, estimate_rad = 0;  ///< white noise of each estimated pose
  double walk_m = 0, walk_rad = 0;          ///< drift of the estimate: random steps, per root of s

  Trajectory truth(Random& random) const {
    return sampled(truth_hz, random, [&](double t) {
      return T_world_truth(t) * noise(truth_m, truth_rad, random);
    });
  }
  Trajectory estimate(Random& random) const {
    SE3 drift;
    const double root_s = std::sqrt(1 / estimate_hz);
    SE3 last = body(0);
    return sampled(estimate_hz, random, [&](double t) {
      const SE3 now = body(t);
      drift = drift * (last.inverse() * now) * noise(walk_m * root_s, walk_rad * root_s, random);
      last = now;
      return (body(0) * drift * noise(estimate_m, estimate_rad, random)).scaled(1 / scale);
    });
  }

 private:
  /// The estimate's body by the estimate's clock, in metres.
  SE3 body(double t) const {
    return T_world_other.inverse() * T_world_truth(t + time_s) * T_estimate_truth.inverse();
  }
  static SE3 noise(double sigma_m, double sigma_rad, Random& random) {
    Vector6d xi;
    for (int k = 0; k < 6; ++k) xi[k] = random.normal(0, k < 3 ? sigma_m : sigma_rad);
    return SE3::exp(xi);
  }
  template <class Pose>
  Trajectory sampled(double rate_hz, Random& random, Pose pose) const {
    Trajectory trajectory;
    const double phase_s = random.uniform(0, 1 / rate_hz);
    for (int i = 0; i < duration_s * rate_hz; ++i) {
      const double t = phase_s + i / rate_hz;
      trajectory.poses.push_back(
          {1'600'000'000'000'000'000 + std::llround(t * 1e9), pose(t).isometry()});
    }
    return trajectory;
  }
};

}  // namespace placegraph::test
