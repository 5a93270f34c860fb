#include <gtest/gtest.h>
#include <placegraph/backend/inertial/error_state_filter.h>

#include <Eigen/LU>

#include "tests/support/scenes/swaying_body.h"

namespace placegraph {
namespace error_state_filter_test {

using test::SwayingBody;

/// Mean over seeded flights of the squared error in units of its covariance, per degree of freedom.
TEST(PositionFilterConsistency, ErrsAsItsCovarianceSaysOverManyFlights) {
  constexpr int kFlights = 20;
  double position = 0, velocity = 0, attitude = 0, square_m2 = 0;
  int judged = 0;
  for (int k = 0; k < kFlights; ++k) {
    const SwayingBody flight{.seed = 100 + static_cast<std::uint64_t>(k), .duration_s = 6};
    Random random(flight.seed);
    ErrorStateFilter filter(flight.noise, flight.T_body_cam);
    filter.start(flight.start(random));
    for (int i = 1; i <= 1200; ++i) {
      const double t = i / flight.imu_hz;
      ASSERT_TRUE(filter.add(flight.imu(t, random)));
      if (i % 10 == 0) (void)filter.add(flight.flow(t - 0.05, t, random));
      if (i % 40 == 0 && (t < 2 || t > 4)) (void)filter.add(flight.marker(t, random));
      if (i % 100 != 0 || t < 1) continue;
      const BodyState state = filter.at(SwayingBody::stamp(t)).state;
      const auto nees = [&](const Eigen::Vector3d& e, int at) {
        const Eigen::Matrix3d P = state.covariance.block<3, 3>(at, at);
        return e.dot(P.inverse() * e) / 3;
      };
      const Eigen::Vector3d e = state.T_world_body.translation() - flight.position(t);
      position += nees(e, 0);
      square_m2 += e.squaredNorm();
      velocity += nees(state.velocity_world - flight.velocity(t), 3);
      attitude += nees((state.T_world_body.rotation().inverse() * flight.rotation(t)).log(), 6);
      ++judged;
    }
  }
  for (const double sum : {position, velocity, attitude}) {
    EXPECT_GT(sum / judged, 0.5);
    EXPECT_LT(sum / judged, 2);
  }
  EXPECT_LT(std::sqrt(square_m2 / judged), 0.03);
}

}  // namespace error_state_filter_test
}  // namespace placegraph
