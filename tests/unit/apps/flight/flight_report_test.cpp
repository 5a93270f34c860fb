#include "apps/flight/flight_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace placegraph::apps {
namespace flight_report_test {

using nlohmann::json;

constexpr std::int64_t kSecond = 1'000'000'000;

/// Where a body that moves along x at 1 m/s is at these seconds, `off_m` to the side.
BodyState state_at(int second, double off_m = 0) {
  BodyState state;
  state.stamp_ns = second * kSecond;
  state.T_world_body = SE3(SO3(), Eigen::Vector3d(second, off_m, 1));
  state.velocity_world = {1, 0, 0};
  state.covariance.setIdentity();
  return state;
}

std::vector<BodyState> truth() {
  std::vector<BodyState> states;
  for (int i = 0; i < 12; ++i) states.push_back(state_at(i));
  return states;
}

/// Images at the seconds 0 to 11: no state at first, markers at 1, 2 and 8, then an error that
/// grows by 0.1 m a second.
FlightRun drifting_flight() {
  FlightRun run;
  for (int i = 0; i < 12; ++i) {
    FlightFrame frame;
    frame.stamp_ns = i * kSecond;
    frame.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no marker yet");
    frame.flow = frame.markers = frame.outcome;
    if (i > 0) frame.outcome = Outcome::ok();
    if (i == 1 || i == 2 || i == 8) frame.markers = Outcome::ok();
    if (i > 2) frame.flow = Outcome::ok();
    frame.state = state_at(i, i > 8 ? 0.1 * (i - 8) : 0);
    run.frames.push_back(frame);
  }
  run.stages = {{"reading", 0.5, 12}};
  return run;
}

TEST(DescribeFlight, CountsTheSourcesOfTheFramesPoses) {
  const json described = describe_flight(drifting_flight(), 0);
  EXPECT_EQ(described["frames"], 12);
  EXPECT_EQ(described["answered"], 11);
  EXPECT_EQ(described["lost_frames"], json::array({0}));
  EXPECT_EQ(described["start_s"], 1);
  EXPECT_EQ(described["frames_with_markers"], 3);
  EXPECT_EQ(described["frames_with_flow"], 9);
  EXPECT_EQ(described["stages"][0]["name"], "reading");
}

TEST(DescribeFlight, MeasuresTheTimesBetweenMarkers) {
  const json described = describe_flight(drifting_flight(), 0);
  ASSERT_EQ(described["outages_s"].size(), 2u);
  EXPECT_NEAR(described["outages_s"][0].get<double>(), 1, 1e-9);
  EXPECT_NEAR(described["outages_s"][1].get<double>(), 6, 1e-9);
  EXPECT_EQ(described["outages_over_5s"], 1);
  EXPECT_NEAR(described["longest_outage_s"].get<double>(), 6, 1e-9);
}

TEST(DescribeDrift, IsTheErrorSinceTheLastMarker) {
  const json drift = describe_drift(truth(), drifting_flight());
  EXPECT_NEAR(drift["seconds"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(drift["path_length_m"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(drift["end_error_m"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(drift["percent"].get<double>(), 10, 1e-9);
}

TEST(DescribeDrift, IsNothingWhereAMarkerWasSeenLast) {
  FlightRun run = drifting_flight();
  run.frames.back().markers = Outcome::ok();
  EXPECT_TRUE(describe_drift(truth(), run).is_null());
}

TEST(DescribeError, IsThatOfTheStatesOrSaysWhyThereIsNone) {
  std::vector<BodyState> states;
  for (int i = 2; i < 8; ++i) states.push_back(state_at(i, 0.2));
  const json error = describe_error(truth(), states);
  EXPECT_EQ(error["compared"], 6);
  EXPECT_NEAR(error["position_rmse_m"].get<double>(), 0.2, 1e-9);
  EXPECT_NEAR(error["velocity_rmse_mps"].get<double>(), 0, 1e-9);
  EXPECT_TRUE(describe_error(truth(), {}).contains("refused"));
}

TEST(DescribeSmoother, ComparesTheFilterOverTheSameImages) {
  std::vector<BodyState> smoothed;
  for (int i = 9; i < 12; ++i) smoothed.push_back(state_at(i, 0.05 * (i - 8)));
  const json smoother = describe_smoother(truth(), drifting_flight(), smoothed);
  EXPECT_NEAR(smoother["filter_over_smoother"].get<double>(), 2, 1e-9);  // half of 0.1, 0.2, 0.3
}

TEST(FramesCsv, HasALineAnImage) {
  const std::string csv = frames_csv(drifting_flight());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  EXPECT_THAT(csv,
              testing::HasSubstr("\n0,0,0,0,0.000,0,0,1.00000,1.00000,1.00000,no marker yet\n"));
  EXPECT_THAT(csv, testing::HasSubstr("\n8000000000,1,1,0,0.000,1,0,1.00000,1.00000,1.00000,\n"));
}

}  // namespace flight_report_test
}  // namespace placegraph::apps
