#include <gtest/gtest.h>
#include <placegraph/backend/inertial/inertial_window.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/swaying_body.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace inertial_window_test {

using test::SwayingBody;
using Code = Outcome::Code;

/// A window after two seconds of flight.
InertialWindow after_two_seconds(const SwayingBody& flight, Random& random,
                                 const InertialWindowOptions& options = {}) {
  InertialWindow window(options, flight.T_body_cam);
  window.start(flight.start(random));
  int refused = 0;
  for (int k = 1; k <= 400; ++k) {
    EXPECT_TRUE(window.add(flight.imu(k / 200.0, random)));
    if (k % 10 != 0) continue;
    const double t = k / 200.0;
    refused += !window.add(flight.flow(t - 0.05, t, random));
    refused += !window.add(flight.marker(t, random));
  }
  EXPECT_LE(refused, 2) << "of eighty, gated at one in a thousand";
  return window;
}

TEST(InertialWindow, HoldsThePosition) {
  Random random = test::seeded_random(1);
  const SwayingBody flight;
  InertialWindow window = after_two_seconds(flight, random);
  const auto estimate = window.solve();
  ASSERT_TRUE(estimate.outcome);
  ASSERT_EQ(estimate.states.size(), 20u);
  for (const BodyState& state : estimate.states) {
    const double t = 1e-9 * static_cast<double>(state.stamp_ns);
    // Markers of 1 cm, twenty a second.
    EXPECT_LT((state.T_world_body.translation() - flight.position(t)).norm(), 0.02);
    EXPECT_LT((state.velocity_world - flight.velocity(t)).norm(), 0.05);
    EXPECT_LT((state.gyro_bias - flight.gyro_bias).norm(), 0.015);
  }
}

TEST(InertialWindow, RotatesFromItsStartAsTheFirstSampleSays) {
  InertialWindow window({}, SE3());
  BodyState start;
  start.covariance = 1e-4 * Eigen::Matrix<double, 15, 15>::Identity();
  window.start(start);
  for (const double t : {0.01, 0.02})
    ASSERT_TRUE(window.add(ImuSample{SwayingBody::stamp(t), {0, 0, 1}, {0, 0, 9.80665}}));
  PoseMeasurement vague;  // makes the state
  vague.stamp_ns = SwayingBody::stamp(0.02);
  vague.covariance = 1e6 * Matrix6d::Identity();
  ASSERT_TRUE(window.add(vague));
  const auto estimate = window.solve();
  ASSERT_TRUE(estimate.outcome);
  ASSERT_EQ(estimate.states.size(), 2u);
  EXPECT_NEAR(estimate.states[1].T_world_body.rotation().log().z(), 0.02, 1e-6);
}

TEST(InertialWindow, RejectsMeasurementsFarFromThePrediction) {
  Random random = test::seeded_random(2);
  const SwayingBody flight;
  InertialWindow window = after_two_seconds(flight, random);
  PoseMeasurement wrong = flight.marker(2, random);
  wrong.T_world_body =
      SE3(wrong.T_world_body.rotation() * SO3::exp({0.5, 0, 0}), wrong.T_world_body.translation());
  EXPECT_EQ(window.add(wrong).code, Code::kInconsistent);
  FlowMeasurement flow = flight.flow(1.95, 2, random);
  flow.over_distance[0] += 0.05;
  EXPECT_EQ(window.add(flow).code, Code::kInconsistent);
  flow.over_distance[0] = NAN;
  EXPECT_EQ(window.add(flow).code, Code::kInconsistent);
  // A late one of the middle of the window is welcome.
  EXPECT_TRUE(window.add(flight.marker(1.5, random)));
}

TEST(InertialWindow, SaysWhatIsOutOfReach) {
  Random random = test::seeded_random(3);
  const SwayingBody flight;
  InertialWindow fresh({}, flight.T_body_cam);
  EXPECT_EQ(fresh.add(flight.marker(0, random)).code, Code::kNotAttempted);
  EXPECT_EQ(fresh.add(flight.flow(0, 0.1, random)).code, Code::kNotAttempted);
  EXPECT_EQ(fresh.add(flight.imu(0, random)).code, Code::kNotAttempted);
  EXPECT_EQ(fresh.solve().outcome.code, Code::kNotAttempted);
  InertialWindow window = after_two_seconds(flight, random);
  EXPECT_EQ(window.add(flight.marker(0.5, random)).code, Code::kTooFewData);   // before it
  EXPECT_EQ(window.add(flight.marker(1.97, random)).code, Code::kTooFewData);  // between states
  EXPECT_EQ(window.add(flight.marker(3, random)).code, Code::kTooFewData);     // no samples
  EXPECT_EQ(window.add(flight.flow(1.8, 2, random)).code, Code::kTooFewData);
  EXPECT_EQ(window.add(flight.imu(1.5, random)).code, Code::kInconsistent);
  BodyState unknown;
  EXPECT_THROW(window.start(unknown), ArgumentError);
  InertialWindowOptions options;
  options.max_states = 1;
  EXPECT_THROW(InertialWindow(options, SE3()), ArgumentError);
}

TEST(InertialWindow, MarginalizationChangesLittle) {
  const SwayingBody flight;
  Random random = test::seeded_random(4);
  Random again = random;
  InertialWindowOptions whole;
  whole.max_states = 100;
  const auto all = after_two_seconds(flight, random, whole).solve();
  const auto last = after_two_seconds(flight, again).solve();
  ASSERT_EQ(all.states.size(), 41u);
  const StateStep off = difference(all.states.back(), last.states.back());
  const StateStep sigma = all.states.back().covariance.diagonal().cwiseSqrt();
  // By what is linearized once and for all: a small share of the deviations.
  for (int i = 0; i < 15; ++i) EXPECT_LT(std::abs(off[i]), 0.1 * sigma[i]) << i;
  const StateStep sigma_last = last.states.back().covariance.diagonal().cwiseSqrt();
  for (int i = 0; i < 15; ++i) EXPECT_NEAR(sigma_last[i] / sigma[i], 1, 0.05) << i;
}

}  // namespace inertial_window_test
}  // namespace placegraph
