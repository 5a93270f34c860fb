#include <gtest/gtest.h>
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/graph/core/error.h>

#include <limits>
#include <variant>

#include "tests/support/scenes/swaying_body.h"

namespace placegraph {
namespace error_state_filter_test {

using Eigen::Vector3d;
using test::SwayingBody;

struct Flown {
  ErrorStateFilter filter;
  double worst_m = 0, nees_per_dof = 0;
};

/// With flow from image to image, and a marker every `marker_every_s` outside [outage, outage + 3).
Flown fly(const SwayingBody& flight, double marker_every_s, double outage_s = 1e9) {
  Random random(flight.seed);
  Flown flown{ErrorStateFilter(flight.noise, flight.T_body_cam)};
  flown.filter.start(flight.start(random));
  const int steps = static_cast<int>(flight.duration_s * flight.imu_hz);
  const int per_image = static_cast<int>(flight.imu_hz / flight.image_hz);
  const int per_marker = static_cast<int>(marker_every_s * flight.imu_hz);
  int judged = 0;
  for (int i = 1; i <= steps; ++i) {
    const double t = i / flight.imu_hz;
    EXPECT_TRUE(flown.filter.add(flight.imu(t, random)));
    if (i % per_image == 0) (void)flown.filter.add(flight.flow(t - 1 / flight.image_hz, t, random));
    if (i % per_marker == 0 && !(t >= outage_s && t < outage_s + 3))
      (void)flown.filter.add(flight.marker(t, random));
    if (i % per_image != 0 || t < 1) continue;
    const auto estimate = flown.filter.at(SwayingBody::stamp(t));
    EXPECT_TRUE(estimate.outcome) << estimate.outcome.reason;
    const Vector3d e = estimate.state.T_world_body.translation() - flight.position(t);
    flown.worst_m = std::max(flown.worst_m, e.norm());
    const Eigen::Matrix3d P = estimate.state.covariance.topLeftCorner<3, 3>();
    flown.nees_per_dof += e.dot(P.inverse() * e) / 3;
    ++judged;
  }
  flown.nees_per_dof /= judged;
  return flown;
}

TEST(ErrorStateFilter, HoldsThePositionByFlowAndMarkersThroughAnOutage) {
  const Flown flown = fly({.duration_s = 8}, 0.2, 4);
  EXPECT_LT(flown.worst_m, 0.05);
}

TEST(ErrorStateFilter, RotatesFromItsStartAsTheFirstSampleSays) {
  ErrorStateFilter filter({}, SE3());
  BodyState start;
  start.covariance = 1e-4 * Eigen::Matrix<double, 15, 15>::Identity();
  filter.start(start);
  for (const double t : {0.01, 0.02})
    ASSERT_TRUE(filter.add(ImuSample{SwayingBody::stamp(t), {0, 0, 1}, {0, 0, 9.80665}}));
  const auto estimate = filter.at(SwayingBody::stamp(0.02));
  ASSERT_TRUE(estimate.outcome);
  EXPECT_NEAR(estimate.state.T_world_body.rotation().log().z(), 0.02, 1e-9);
}

TEST(ErrorStateFilter, IsTheSameInWhateverOrderMeasurementsArrive) {
  const SwayingBody flight;
  Random random(3);
  ErrorStateFilter in_time(flight.noise, flight.T_body_cam), late(flight.noise, flight.T_body_cam);
  const BodyState start = flight.start(random);
  in_time.start(start);
  late.start(start);
  std::vector<PoseMeasurement> pending;
  for (int i = 1; i <= 200; ++i) {
    const double t = i / flight.imu_hz;
    const ImuSample sample = flight.imu(t, random);
    ASSERT_TRUE(in_time.add(sample));
    ASSERT_TRUE(late.add(sample));
    if (i % 20 == 0) {
      const PoseMeasurement seen = flight.marker(t, random);
      ASSERT_TRUE(in_time.add(seen));
      pending.push_back(seen);
    }
    if (i % 60 == 0) {  // two tenths of a second late, and the newest first
      for (; !pending.empty(); pending.pop_back()) ASSERT_TRUE(late.add(pending.back()));
    }
  }
  const auto a = in_time.at(SwayingBody::stamp(0.9)), b = late.at(SwayingBody::stamp(0.9));
  ASSERT_TRUE(a.outcome && b.outcome);
  EXPECT_LT((a.state.T_world_body.inverse() * b.state.T_world_body).log().norm(), 1e-9);
  EXPECT_LT((a.state.covariance - b.state.covariance).norm(), 1e-12);
}

TEST(ErrorStateFilter, TakesFlowAndMarkersInAnyOrderWithinItsHistory) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const SwayingBody flight;
    Random random(seed), order(seed, 7);
    ErrorStateFilter in_time(flight.noise, flight.T_body_cam),
        late(flight.noise, flight.T_body_cam);
    const BodyState start = flight.start(random);
    in_time.start(start);
    late.start(start);
    std::vector<std::variant<PoseMeasurement, FlowMeasurement>> pending;
    for (int i = 1; i <= 160; ++i) {
      const double t = i / flight.imu_hz;
      const ImuSample sample = flight.imu(t, random);
      ASSERT_TRUE(in_time.add(sample));
      ASSERT_TRUE(late.add(sample));
      if (i % 10 == 0) pending.push_back(flight.flow(t - 10 / flight.imu_hz, t, random));
      if (i % 20 == 0) pending.push_back(flight.marker(t, random));
      for (std::size_t k = pending.size() - (i % 20 == 0   ? 2
                                             : i % 10 == 0 ? 1
                                                           : 0);
           k < pending.size(); ++k)
        ASSERT_TRUE(std::visit([&](const auto& seen) { return in_time.add(seen); }, pending[k]));
      if (i % 80 != 0) continue;
      while (!pending.empty()) {  // up to four tenths of a second late, shuffled
        const auto next = pending.begin() + order.index(static_cast<int>(pending.size()));
        ASSERT_TRUE(std::visit([&](const auto& seen) { return late.add(seen); }, *next));
        pending.erase(next);
      }
    }
    const auto a = in_time.at(SwayingBody::stamp(0.8)), b = late.at(SwayingBody::stamp(0.8));
    ASSERT_TRUE(a.outcome && b.outcome);
    EXPECT_LT((a.state.T_world_body.inverse() * b.state.T_world_body).log().norm(), 1e-9);
    EXPECT_LT((a.state.velocity_world - b.state.velocity_world).norm(), 1e-9);
    EXPECT_LT((a.state.covariance - b.state.covariance).norm(), 1e-12);
  }
}

TEST(ErrorStateFilter, RejectsMeasurementsFarFromThePrediction) {
  const SwayingBody flight;
  Random random(4);
  Flown flown = fly({.duration_s = 2}, 0.2);
  PoseMeasurement flipped = flight.marker(2.0, random);
  flipped.T_world_body = SE3(flipped.T_world_body.rotation() * SO3::exp({0.6, 0, 0}),
                             flipped.T_world_body.translation());
  EXPECT_GT(flown.filter.deviation2(flipped).value(), 50);
  EXPECT_LT(flown.filter.deviation2(flight.marker(2.0, random)).value(), 30);
  const SE3 before = flown.filter.at(SwayingBody::stamp(2.0)).state.T_world_body;
  EXPECT_EQ(flown.filter.add(flipped).code, Outcome::Code::kInconsistent);
  EXPECT_EQ(flown.filter.at(SwayingBody::stamp(2.0)).state.T_world_body.translation(),
            before.translation());
}

TEST(ErrorStateFilter, RefusesRatherThanGuessWhereItsInputsStop) {
  const SwayingBody flight;
  Random random(5);
  ErrorStateFilter filter(flight.noise, flight.T_body_cam);
  EXPECT_EQ(filter.add(flight.imu(0.1, random)).code, Outcome::Code::kNotAttempted);
  EXPECT_EQ(filter.add(flight.marker(0.1, random)).code, Outcome::Code::kNotAttempted);
  EXPECT_EQ(filter.at(0).outcome.code, Outcome::Code::kNotAttempted);
  filter.start(flight.start(random));
  for (int i = 1; i <= 200; ++i) ASSERT_TRUE(filter.add(flight.imu(i / 200.0, random)));
  EXPECT_TRUE(filter.at(SwayingBody::stamp(1.1)).outcome) << "a tenth of a second ahead";
  EXPECT_EQ(filter.at(SwayingBody::stamp(1.5)).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(filter.at(SwayingBody::stamp(0.2)).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(filter.add(flight.marker(0.2, random)).code, Outcome::Code::kTooFewData);
  EXPECT_EQ(filter.add(flight.marker(1.6, random)).code, Outcome::Code::kTooFewData);
  EXPECT_EQ(filter.add(flight.imu(0.9, random)).code, Outcome::Code::kInconsistent);
  PoseMeasurement broken = flight.marker(1.0, random);
  broken.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(filter.add(broken).code, Outcome::Code::kInconsistent);
  FlowMeasurement backwards = flight.flow(0.9, 1.0, random);
  std::swap(backwards.from_ns, backwards.to_ns);
  EXPECT_EQ(filter.add(backwards).code, Outcome::Code::kInconsistent);
  // Nothing but inertial samples: the position is less and less known, until it is no answer.
  for (int i = 201; i <= 2400; ++i) ASSERT_TRUE(filter.add(flight.imu(i / 200.0, random)));
  EXPECT_EQ(filter.at(SwayingBody::stamp(12.0)).outcome.code, Outcome::Code::kDegenerate);
  BodyState nowhere;
  nowhere.velocity_world.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(filter.start(nowhere), ArgumentError);
}

TEST(ErrorStateFilter, LearnsTheBiasesOfItsSensors) {
  const SwayingBody flight{.duration_s = 10};
  const Flown flown = fly(flight, 0.1);
  const BodyState state = flown.filter.at(SwayingBody::stamp(10.0)).state;
  EXPECT_LT((state.gyro_bias - flight.gyro_bias).norm(), 0.002);
  EXPECT_LT((state.accel_bias - flight.accel_bias).norm(), 0.03);
}

}  // namespace error_state_filter_test
}  // namespace placegraph
