#include <gtest/gtest.h>
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/backend/inertial/inertial_window.h>

#include <Eigen/LU>
#include <iostream>

#include "tests/support/scenes/swaying_body.h"

namespace placegraph {
namespace inertial_window_test {

using test::SwayingBody;

/// Squared errors, and those in units of their covariances per degree of freedom.
struct Tally {
  double square_m2 = 0, position = 0, velocity = 0, attitude = 0;
  int judged = 0;

  void judge(const SwayingBody& flight, const BodyState& state) {
    const double t = 1e-9 * static_cast<double>(state.stamp_ns);
    const auto nees = [&](const Eigen::Vector3d& e, int at) {
      const Eigen::Matrix3d P = state.covariance.block<3, 3>(at, at);
      return e.dot(P.inverse() * e) / 3;
    };
    const Eigen::Vector3d e = state.T_world_body.translation() - flight.position(t);
    square_m2 += e.squaredNorm();
    position += nees(e, 0);
    velocity += nees(state.velocity_world - flight.velocity(t), 3);
    attitude += nees((state.T_world_body.rotation().inverse() * flight.rotation(t)).log(), 6);
    ++judged;
  }
  double rmse_m() const { return std::sqrt(square_m2 / judged); }
};

/// The filter and the window get the same measurements, markers missing for two seconds; judged is
/// what each says at the time, and what the window says of its oldest state, a second later.
TEST(InertialWindowConsistency, IsAsGoodAsTheFilterAtOnceAndBetterASecondLater) {
  constexpr int kFlights = 10;
  Tally filtered, newest, oldest;
  for (int k = 0; k < kFlights; ++k) {
    const SwayingBody flight{.seed = 300 + static_cast<std::uint64_t>(k), .duration_s = 6};
    Random random(flight.seed);
    ErrorStateFilter filter(flight.noise, flight.T_body_cam);
    const InertialWindowOptions options;
    InertialWindow window(options, flight.T_body_cam);
    const BodyState start = flight.start(random);
    filter.start(start);
    window.start(start);
    for (int i = 1; i <= 1200; ++i) {
      const double t = i / flight.imu_hz;
      const ImuSample sample = flight.imu(t, random);
      ASSERT_TRUE(filter.add(sample));
      ASSERT_TRUE(window.add(sample));
      if (i % 10 == 0) {
        const FlowMeasurement flow = flight.flow(t - 0.05, t, random);
        (void)filter.add(flow);
        (void)window.add(flow);
      }
      if (i % 40 == 0 && (t < 2 || t > 4)) {
        const PoseMeasurement marker = flight.marker(t, random);
        (void)filter.add(marker);
        (void)window.add(marker);
      }
      if (i % 100 != 0 || t < 2) continue;
      filtered.judge(flight, filter.at(SwayingBody::stamp(t)).state);
      const auto estimate = window.solve();
      newest.judge(flight, estimate.states.back());
      oldest.judge(flight, estimate.states.front());
    }
  }
  std::cout << "position RMSE: filter " << filtered.rmse_m() << " m, window at once "
            << newest.rmse_m() << " m, a second later " << oldest.rmse_m() << " m\n";
  for (const Tally* tally : {&newest, &oldest})
    for (const double sum : {tally->position, tally->velocity, tally->attitude}) {
      EXPECT_GT(sum / tally->judged, 0.5);
      EXPECT_LT(sum / tally->judged, 2);
      std::cout << "NEES " << sum / tally->judged << "\n";
    }
  EXPECT_LT(newest.rmse_m(), 1.05 * filtered.rmse_m());
  EXPECT_LT(oldest.rmse_m(), filtered.rmse_m());
}

}  // namespace inertial_window_test
}  // namespace placegraph
