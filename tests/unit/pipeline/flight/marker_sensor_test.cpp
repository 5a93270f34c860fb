#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/marker_sensor.h>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_sensor_test {

using Code = Outcome::Code;
using Eigen::Vector3d;

const SE3 kBodyCam(SO3::exp({std::numbers::pi, 0, 0}), Vector3d(0.05, 0, -0.02));
const SE3 kWorldBody(SO3::exp({0, 0, 0.3}), Vector3d(0.02, -0.03, 1.5));
const Outcome kRefuted = Outcome::failure(Code::kInconsistent, "outside the gate");

/// Four markers on the floor, far enough from each other that what is searched around one does not
/// reach the next; marker 1 is the largest, then 2.
MarkerLayout four_markers() {
  MarkerLayout layout;
  layout.markers = {{1, 0.24, SE3(SO3(), Vector3d(-0.6, 0.4, 0))},
                    {2, 0.21, SE3(SO3(), Vector3d(0.6, 0.4, 0))},
                    {3, 0.18, SE3(SO3(), Vector3d(-0.6, -0.4, 0))},
                    {4, 0.18, SE3(SO3(), Vector3d(0.6, -0.4, 0))}};
  return layout;
}

/// The image from `kWorldBody`.
const Image& image_of_four() {
  static const Image image = [] {
    Random random = test::seeded_random(1);
    return test::MarkerScene{
        .layout = four_markers(), .camera = test::MarkerScene::usual_camera(), .samples = 3}
        .render(kWorldBody * kBodyCam, random);
  }();
  return image;
}

/// A state whose position and attitude are known this well [m, rad].
BodyState state_at(const SE3& T_world_body, double position_sigma = 1e-3,
                   double attitude_sigma = 1e-3) {
  BodyState state;
  state.T_world_body = T_world_body;
  state.covariance.diagonal().head<3>().setConstant(position_sigma * position_sigma);
  state.covariance.diagonal().segment<3>(6).setConstant(attitude_sigma * attitude_sigma);
  return state;
}

SE3 shifted(double x_m, double y_m) {
  return {kWorldBody.rotation(), Vector3d(kWorldBody.translation() + Vector3d(x_m, y_m, 0))};
}

MarkerSensor sensor_of(const MarkerLayout& layout, const MarkerSensorOptions& options = {}) {
  return {options, test::MarkerScene::usual_camera(), kBodyCam, layout};
}

std::vector<int> ids(const MarkerDetections& found) {
  std::vector<int> result;
  for (const MarkerObservation& marker : found.markers) result.push_back(marker.id);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<int> detected(MarkerSensor& sensor, const std::optional<BodyState>& expected) {
  StageTimes times;
  return ids(sensor.detect(image_of_four(), expected, times));
}

const std::vector<int> kAll{1, 2, 3, 4}, kNone;

TEST(MarkerSensor, SearchesTheWholeImageWhereNothingIsExpected) {
  MarkerSensor sensor = sensor_of(four_markers(), {.max_markers = 1});
  EXPECT_EQ(detected(sensor, std::nullopt), kAll);
  EXPECT_EQ(detected(sensor, std::nullopt), kAll);
}

TEST(MarkerSensor, SearchesWhereTheLargestMarkersAreExpected) {
  const BodyState expected = state_at(kWorldBody);
  MarkerSensor one = sensor_of(four_markers(), {.max_markers = 1});
  EXPECT_EQ(detected(one, expected), std::vector<int>{1});
  MarkerSensor two = sensor_of(four_markers(), {.max_markers = 2});
  EXPECT_EQ(detected(two, expected), (std::vector<int>{1, 2}));
  MarkerSensor all = sensor_of(four_markers());
  EXPECT_EQ(detected(all, expected), kAll);
}

/// A centimetre is 3 px here. A state that is wrong by 12 cm finds the markers only if it says that
/// it may be: its position or its attitude (1.5 m over the floor).
TEST(MarkerSensor, SearchesAsFarAsTheStateIsUncertain) {
  const SE3 wrong = shifted(0.12, 0);
  MarkerSensor sensor = sensor_of(four_markers());
  EXPECT_EQ(detected(sensor, state_at(wrong)), kNone);
  EXPECT_EQ(detected(sensor, state_at(wrong, 0.03, 1e-3)), kAll);
  EXPECT_EQ(detected(sensor, state_at(wrong, 1e-3, 0.02)), kAll);
}

/// A body whose axes are not those of the world. An error along the floor moves the markers in the
/// image by 3 px a centimetre; an error in height moves them by half of that at most.
TEST(MarkerSensor, TakesThePositionsCovarianceFromTheWorldToTheBody) {
  const double tilt = 80 * std::numbers::pi / 180;
  const SE3 T_body_cam(SO3::exp({std::numbers::pi, 0, 0}) * SO3::exp({0, tilt, 0}),
                       Vector3d::Zero());
  // The camera looks down though the body does not: the same image.
  const SE3 T_world_body = kWorldBody * kBodyCam * T_body_cam.inverse();
  const SE3 wrong(T_world_body.rotation(),
                  Vector3d(T_world_body.translation() + Vector3d(0.12, 0, 0)));
  const auto found_with = [&](const Vector3d& sigma_world) {
    MarkerSensor sensor({}, test::MarkerScene::usual_camera(), T_body_cam, four_markers());
    BodyState state = state_at(wrong);
    state.covariance.diagonal().head<3>() = sigma_world.cwiseAbs2();
    return detected(sensor, state);
  };
  EXPECT_EQ(found_with({0.03, 0.03, 1e-3}), kAll);
  EXPECT_EQ(found_with({1e-3, 1e-3, 0.02}), kNone);
}

TEST(MarkerSensor, SearchesFartherOnceMarkersContradictTheState) {
  const BodyState wrong = state_at(shifted(0.12, 0));
  MarkerSensor sensor = sensor_of(four_markers());
  EXPECT_EQ(detected(sensor, wrong), kNone);
  sensor.report(kRefuted, true);
  EXPECT_EQ(detected(sensor, wrong), kAll);
  sensor.report(Outcome::ok(), true);
  EXPECT_EQ(detected(sensor, wrong), kNone);
}

TEST(MarkerSensor, SearchesTheWholeImageNowAndThenWhileNoMarkerIsAccepted) {
  const BodyState wrong = state_at(shifted(0.5, 0.4));
  MarkerSensor sensor = sensor_of(four_markers(), {.search_interval = 3});
  for (int i = 1; i <= 9; ++i) EXPECT_EQ(detected(sensor, wrong), i % 3 == 0 ? kAll : kNone) << i;
  // The count begins anew with a pose that is accepted, and with an image that is searched whole.
  EXPECT_EQ(detected(sensor, wrong), kNone);
  EXPECT_EQ(detected(sensor, wrong), kNone);
  sensor.report(Outcome::ok(), true);
  EXPECT_EQ(detected(sensor, wrong), kNone);
  EXPECT_EQ(detected(sensor, wrong), kNone);
  EXPECT_EQ(detected(sensor, std::nullopt), kAll);
  EXPECT_EQ(detected(sensor, wrong), kNone);
  EXPECT_EQ(detected(sensor, wrong), kNone);
  EXPECT_EQ(detected(sensor, wrong), kAll);
}

/// Whether an image is searched for beacons.
bool beacons_searched(const MarkerLayout& layout, const Image& image,
                      const std::optional<BodyState>& expected) {
  MarkerSensor sensor = sensor_of(layout);
  StageTimes times;
  (void)sensor.detect(image, expected, times);
  return std::any_of(times.stages().begin(), times.stages().end(),
                     [](const StageTime& stage) { return stage.name == "detect beacons"; });
}

TEST(MarkerSensor, SearchesForBeaconsThatMayBeInView) {
  const Camera camera = test::MarkerScene::usual_camera();
  const Image plain(camera.height, camera.width, CV_8UC1, cv::Scalar(90));
  const SE3 T_world_cam = kWorldBody * kBodyCam;
  const auto beacon_at = [&](double u, double v) {
    const Vector3d ray = T_world_cam.rotation() * *camera.unproject({u, v});
    MarkerLayout layout;
    layout.beacons_world = {T_world_cam.translation() -
                            T_world_cam.translation().z() / ray.z() * ray};
    return layout;
  };
  const BodyState expected = state_at(kWorldBody);
  EXPECT_TRUE(beacons_searched(beacon_at(320, 240), plain, expected));
  EXPECT_TRUE(beacons_searched(beacon_at(camera.width + 30, 240), plain, expected));
  EXPECT_FALSE(beacons_searched(beacon_at(camera.width + 60, 240), plain, expected));
  EXPECT_TRUE(beacons_searched(beacon_at(camera.width + 60, 240), plain, std::nullopt));
}

TEST(MarkerSensor, SearchesForBeaconsOnlyWhereMarkersAreFew) {
  MarkerLayout layout = four_markers();
  layout.beacons_world = {Vector3d(0, 0, 0)};
  const BodyState expected = state_at(kWorldBody);
  EXPECT_FALSE(beacons_searched(layout, image_of_four(), expected));
  layout.markers.resize(2);
  EXPECT_TRUE(beacons_searched(layout, image_of_four(), expected));
}

TEST(MarkerSensor, IsRefutedByContradictionsInARow) {
  MarkerSensor sensor = sensor_of(four_markers(), {.restart_after = 3});
  const Outcome none = Outcome::failure(Code::kTooFewData, "none in view");
  for (int i = 0; i < 2; ++i) sensor.report(kRefuted, true);
  EXPECT_FALSE(sensor.is_refuted());
  // Images without markers, or with too few, say nothing.
  for (int i = 0; i < 5; ++i) sensor.report(none, true);
  for (int i = 0; i < 5; ++i) sensor.report(kRefuted, false);
  EXPECT_FALSE(sensor.is_refuted());
  sensor.report(kRefuted, true);
  EXPECT_TRUE(sensor.is_refuted());
  sensor.report(Outcome::ok(), true);
  EXPECT_FALSE(sensor.is_refuted());
  for (int i = 0; i < 2; ++i) sensor.report(kRefuted, true);
  EXPECT_FALSE(sensor.is_refuted());
}

/// A single small marker has two poses that explain it alike. The expected state tells them apart,
/// until the markers have refuted it.
TEST(MarkerSensor, AsksTheExpectedStateUntilItIsRefuted) {
  const Camera camera = test::MarkerScene::usual_camera();
  MarkerLayout layout;
  layout.markers = {{5, 0.1, SE3()}};
  const SE3 T_world_body = test::looking_at_origin(2, 0.35, 0.5, 0.2) * kBodyCam.inverse();
  MarkerObservation observation;
  observation.id = 5;
  observation.covariance *= 0.04;
  const auto corners = layout.markers[0].corners_marker();
  for (std::size_t i = 0; i < 4; ++i)
    observation.corners_px[i] = *camera.project((T_world_body * kBodyCam).inverse() * corners[i]);
  MarkerView view{1'000'000'000, {observation}, {}, std::nullopt, std::nullopt};
  BodyExpectation expectation;
  expectation.state = state_at(T_world_body, 0.05, 0.05);
  expectation.deviation2 = [&](const PoseMeasurement& pose) -> std::optional<double> {
    const Vector6d error = (T_world_body.inverse() * pose.T_world_body).log();
    return error.squaredNorm() / (0.05 * 0.05);
  };
  MarkerSensor sensor = sensor_of(layout, {.restart_after = 2});
  EXPECT_EQ(sensor.estimate(view, {}).outcome.code, Code::kInconsistent);
  // Years later, so that the views before are forgotten.
  const auto later = [&] {
    view.stamp_ns *= 2;
    return view;
  };
  const MarkerPoseEstimate estimate = sensor.estimate(later(), expectation);
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_EQ(estimate.markers, 1);
  // The corners are exact; the expectation does not shift the pose.
  EXPECT_LT((estimate.observation.T_world_body.inverse() * T_world_body).log().norm(), 1e-3);
  for (int i = 0; i < 2; ++i) sensor.report(kRefuted, true);
  EXPECT_EQ(sensor.estimate(later(), expectation).outcome.code, Code::kInconsistent);
}

TEST(MarkerSensor, RefusesLayoutsWithoutMarksAndOptionsOutOfRange) {
  EXPECT_THROW((void)sensor_of({}), ArgumentError);
  EXPECT_THROW((void)sensor_of(four_markers(), {.max_markers = 0}), ArgumentError);
}

}  // namespace marker_sensor_test
}  // namespace placegraph
