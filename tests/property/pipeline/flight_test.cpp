#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/body_state_error.h>

#include "tests/support/scenes/flight_measurements.h"

namespace placegraph {
namespace flight_test {

using test::fly_without_images;

synthetic::Tour tour_of(std::uint64_t seed, double duration_s) {
  synthetic::TourRequest request;
  request.seed = seed;
  request.duration_s = duration_s;
  return synthetic::make_flight_world(request);
}

std::vector<BodyState> estimates(const std::vector<FlightFrame>& frames) {
  std::vector<BodyState> states;
  for (const FlightFrame& frame : frames)
    if (frame.outcome) states.push_back(frame.state);
  return states;
}

/// Errors divided by what the filter says of them, over flights with the markers lost on the way.
TEST(FlightConsistency, ErrsAsItsCovarianceSaysThroughOutages) {
  constexpr int kFlights = 8;
  double anees = 0, position = 0, velocity = 0, attitude = 0;
  for (std::uint64_t seed = 1; seed <= kFlights; ++seed) {
    const synthetic::Tour tour = tour_of(200 + seed, 15);
    const auto frames = fly_without_images(tour, {}, {}, seed, [](double) { return true; });
    const BodyStateError error =
        body_state_error(tour.flight_setting->flight.truth, estimates(frames));
    ASSERT_TRUE(error.outcome) << error.outcome.reason;
    EXPECT_LT(error.position_rmse_m, 0.02) << "seed " << seed;
    EXPECT_LT(error.velocity_rmse_mps, 0.03) << "seed " << seed;
    anees += error.anees / kFlights;
    position += error.anees_position / kFlights;
    velocity += error.anees_velocity / kFlights;
    attitude += error.anees_attitude / kFlights;
  }
  for (const double mean : {anees, position, velocity, attitude}) {
    EXPECT_GT(mean, 0.5);
    EXPECT_LT(mean, 2);
  }
}

TEST(FlightConsistency, GoesOnByFlowAloneAfterItsLastMarker) {
  const synthetic::Tour tour = tour_of(31, 20);
  const auto frames = fly_without_images(tour, {}, {}, 5, [](double t) { return t < 2; });
  const BodyStateError error =
      body_state_error(tour.flight_setting->flight.truth, estimates(frames));
  ASSERT_TRUE(error.outcome);
  EXPECT_EQ(error.compared, 401);
  EXPECT_LT(error.end_error_m, 0.02 * error.path_length_m);
}

TEST(FlightConsistency, MarkersThatComeLateAreWorthAlmostAsMuch) {
  const synthetic::Tour tour = tour_of(32, 12);
  FlightOptions late;
  late.marker_delay_s = 0.2;
  const auto frames = fly_without_images(tour, late, {}, 6, [](double) { return true; });
  const BodyStateError error =
      body_state_error(tour.flight_setting->flight.truth, estimates(frames));
  ASSERT_TRUE(error.outcome);
  EXPECT_LT(error.position_rmse_m, 0.03);
  EXPECT_LT(error.velocity_rmse_mps, 0.1);
}

/// Once all has come, it is as if it had come in time: but for the turns that were taken out of
/// flow while the gyro's bias was known otherwise.
TEST(FlightConsistency, OnceLateMarkersHaveComeTheStateIsThatOfMarkersInTime) {
  for (const std::uint64_t seed : {41, 42, 43}) {
    const synthetic::Tour tour = tour_of(seed, 8);
    const auto until_six = [](double t) { return t < 6; };
    FlightOptions late;
    late.marker_delay_s = 0.3;
    const auto in_time = fly_without_images(tour, {}, {}, seed, until_six),
               delayed = fly_without_images(tour, late, {}, seed, until_six);
    ASSERT_TRUE(in_time.back().outcome && delayed.back().outcome);
    const BodyState &a = in_time.back().state, &b = delayed.back().state;
    // A tenth of what either is sure of.
    const Eigen::Matrix<double, 15, 1> sigma = a.covariance.diagonal().cwiseSqrt();
    EXPECT_LT((a.T_world_body.translation() - b.T_world_body.translation()).norm(),
              0.1 * sigma.head<3>().norm());
    EXPECT_LT((a.velocity_world - b.velocity_world).norm(), 0.1 * sigma.segment<3>(3).norm());
    EXPECT_LT((a.T_world_body.rotation().inverse() * b.T_world_body.rotation()).log().norm(),
              0.1 * sigma.segment<3>(6).norm());
    EXPECT_LT((a.covariance - b.covariance).norm(), 0.02 * a.covariance.norm());
  }
}

TEST(FlightConsistency, ErrsAsItsCovarianceSaysWhereImagesAreDropped) {
  double anees = 0;
  constexpr int kFlights = 4;
  for (std::uint64_t seed = 1; seed <= kFlights; ++seed) {
    const synthetic::Tour tour = tour_of(50 + seed, 15);
    Random random(seed, 9);
    std::vector<bool> dropped(tour.flight_setting->flight.images.size());
    // Every third at random, and three times a quarter of a second of them.
    for (std::size_t i = 0; i < dropped.size(); ++i)
      dropped[i] = random.uniform() < 1 / 3.0 || (i % 100 >= 60 && i % 100 < 65);
    const auto frames = fly_without_images(
        tour, {}, {}, seed, [](double) { return true; }, [&](std::size_t i) { return dropped[i]; });
    const BodyStateError error =
        body_state_error(tour.flight_setting->flight.truth, estimates(frames));
    ASSERT_TRUE(error.outcome) << error.outcome.reason;
    EXPECT_GT(error.compared, 0.95 * static_cast<double>(frames.size()));
    EXPECT_LT(error.position_rmse_m, 0.02) << "seed " << seed;
    EXPECT_LT(error.velocity_rmse_mps, 0.03) << "seed " << seed;
    anees += error.anees / kFlights;
  }
  EXPECT_GT(anees, 0.5);
  EXPECT_LT(anees, 2);
}

/// The same measurements where the layout's world is rotated about the vertical and shifted: the
/// states are, too, and what the filter accepts stays the same.
TEST(FlightLaw, RotatingTheWorldAboutTheVerticalRotatesTheStates) {
  const synthetic::Tour tour = tour_of(61, 6);
  const synthetic::FlightSetting& setting = *tour.flight_setting;
  const SE3 T_other_world(SO3::exp({0, 0, 2.1}), Eigen::Vector3d(3, -2, 0));
  MarkerLayout other = setting.layout;
  for (PlacedMarker& marker : other.markers)
    marker.T_world_marker = T_other_world * marker.T_world_marker;
  for (Eigen::Vector3d& beacon : other.beacons_world) beacon = T_other_world * beacon;
  FlightEstimator here({}, tour.camera, setting.T_body_cam, setting.layout),
      there({}, tour.camera, setting.T_body_cam, other);
  test::FlightMeasurementsSource source(tour, {}, 3);
  std::size_t sample = 0;
  int frames_with_state = 0;
  for (std::size_t i = 0; i < setting.flight.images.size(); ++i) {
    for (; sample <= setting.flight.images[i]; ++sample) {
      (void)here.add(setting.flight.imu.samples[sample]);
      (void)there.add(setting.flight.imu.samples[sample]);
    }
    const FlightMeasurements observations = source.observe(i, i % 60 < 30);
    const FlightFrame a = here.add(observations), b = there.add(observations);
    ASSERT_EQ(a.outcome.code, b.outcome.code) << i;
    ASSERT_EQ(a.flow.code, b.flow.code) << i;
    ASSERT_EQ(a.markers.code, b.markers.code) << i;
    if (!a.outcome) continue;
    ++frames_with_state;
    const SE3 T_expected = T_other_world * a.state.T_world_body;
    // Rounding, through the descents that pose the markers.
    EXPECT_LT((T_expected.inverse() * b.state.T_world_body).log().norm(), 1e-5) << i;
    EXPECT_LT((T_other_world.rotation() * a.state.velocity_world - b.state.velocity_world).norm(),
              1e-5)
        << i;
  }
  EXPECT_GT(frames_with_state, 100);
}

}  // namespace flight_test
}  // namespace placegraph
