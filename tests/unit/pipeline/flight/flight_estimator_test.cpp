#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/flight_estimator.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace flight_estimator_test {

using Code = Outcome::Code;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::int64_t kBegin_ns = 1'000'000'000, kImage_ns = 50'000'000, kSample_ns = 5'000'000;
const Camera kCamera{.width = 640, .height = 480, .fx = 400, .fy = 400, .cx = 319.5, .cy = 239.5};
const SE3 kBodyCam(SO3::exp({std::numbers::pi, 0, 0}), Vector3d(0, 0, 0));  // looks down

/// A body at 1.5 m that stands still, or slides along x at this speed, over three markers.
struct Scene {
  double speed_mps = 0;
  MarkerLayout layout = [] {
    MarkerLayout made;
    for (int i = 0; i < 3; ++i)
      made.markers.push_back({i, 0.2, SE3(SO3(), Vector3d(0.4 * (i - 1), 0.3 * (i % 2), 0))});
    return made;
  }();

  SE3 T_world_cam(std::int64_t stamp_ns) const {
    const double x = 1e-9 * speed_mps * static_cast<double>(stamp_ns - kBegin_ns);
    return SE3(SO3(), Vector3d(x, 0, 1.5)) * kBodyCam;
  }
  Vector2d seen(const Vector3d& p_world, std::int64_t stamp_ns) const {
    return *kCamera.project(T_world_cam(stamp_ns).inverse() * p_world);
  }
  FlightMeasurements observations(int image, bool markers = true) const {
    FlightMeasurements result;
    result.stamp_ns = kBegin_ns + image * kImage_ns;
    for (double x = -0.6; image > 0 && x < 0.7; x += 0.2)
      for (double y = -0.4; y < 0.5; y += 0.2) {
        FlowVector vector;
        vector.kind = FlowVector::Kind::kFull;
        vector.px = seen({x, y, 0}, result.stamp_ns - kImage_ns);
        vector.flow = seen({x, y, 0}, result.stamp_ns) - vector.px;
        vector.covariance = 0.01 * Eigen::Matrix2d::Identity();
        result.flow.push_back(vector);
      }
    for (const PlacedMarker& marker : layout.markers) {
      if (!markers) break;
      MarkerObservation observation;
      observation.id = marker.id;
      observation.covariance *= 0.01;
      const auto corners = marker.corners_marker();
      for (std::size_t i = 0; i < 4; ++i)
        observation.corners_px[i] = seen(marker.T_world_marker * corners[i], result.stamp_ns);
      result.markers.push_back(observation);
    }
    return result;
  }
  /// The samples from the image before on.
  static void feel(FlightEstimator& estimator, int image) {
    for (int k = image == 0 ? 10 : 1; k <= 10; ++k)
      ASSERT_NE(estimator
                    .add({kBegin_ns + (image - 1) * kImage_ns + k * kSample_ns, Vector3d::Zero(),
                          Vector3d(0, 0, 9.80665)})
                    .code,
                Code::kInconsistent);
  }
};

TEST(FlightEstimator, SaysNothingBeforeItsFirstMarker) {
  const Scene scene;
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  Scene::feel(estimator, 0);
  EXPECT_EQ(estimator.add(scene.observations(0, false)).outcome.code, Code::kNotAttempted);
  Scene::feel(estimator, 1);
  const FlightFrame begun = estimator.add(scene.observations(1));
  ASSERT_TRUE(begun.outcome) << begun.outcome.reason;
  EXPECT_LT((begun.state.T_world_body.translation() - Vector3d(0, 0, 1.5)).norm(), 1e-3);
}

TEST(FlightEstimator, DoesNotBeginWithoutItsInertialSensor) {
  const Scene scene;
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  const FlightFrame frame = estimator.add(scene.observations(0));
  EXPECT_EQ(frame.outcome.code, Code::kNotAttempted);
  EXPECT_EQ(frame.markers.code, Code::kTooFewData);
}

TEST(FlightEstimator, GoesOnByFlowWhereNoMarkerIsSeen) {
  const Scene scene{.speed_mps = 0.5};
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  FlightFrame last;
  for (int image = 0; image < 20; ++image) {
    Scene::feel(estimator, image);
    last = estimator.add(scene.observations(image, image < 5));
  }
  ASSERT_TRUE(last.outcome);
  EXPECT_TRUE(last.flow);
  EXPECT_EQ(last.flow_points, 35);
  EXPECT_EQ(last.markers.code, Code::kTooFewData);
  EXPECT_NEAR(last.state.velocity_world.x(), 0.5, 1e-2);
  EXPECT_NEAR(last.state.T_world_body.translation().x(), 0.5 * 0.05 * 19, 5e-3);
}

TEST(FlightEstimator, FallsSilentWhenTheInertialSensorStops) {
  const Scene scene;
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  FlightFrame last;
  for (int image = 0; image < 20; ++image) {
    if (image < 5) Scene::feel(estimator, image);
    last = estimator.add(scene.observations(image));
    if (image < 5) {
      ASSERT_TRUE(last.outcome);
    }
  }
  EXPECT_FALSE(last.outcome);
}

TEST(FlightEstimator, BeginsAnewWhereMarkersContradictItPersistently) {
  const Scene scene;
  FlightOptions options;
  options.marker_sensor.restart_after = 3;
  options.flow.enabled = false;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  BodyState wrong;
  wrong.stamp_ns = kBegin_ns;
  wrong.T_world_body = SE3(SO3(), Vector3d(1, 0, 1.5));
  wrong.covariance.diagonal().setConstant(1e-8);
  Scene::feel(estimator, 0);
  estimator.start(wrong);
  for (int image = 1; image <= 5; ++image) {
    Scene::feel(estimator, image);
    const FlightFrame frame = estimator.add(scene.observations(image));
    ASSERT_TRUE(frame.outcome);
    EXPECT_EQ(static_cast<bool>(frame.markers), image > 3) << image;
    EXPECT_NEAR(frame.state.T_world_body.translation().x(), image > 3 ? 0 : 1, 1e-2) << image;
  }
}

TEST(FlightEstimator, TakesMarkersThatComeLate) {
  const Scene scene;
  FlightOptions options;
  options.marker_delay_s = 0.1;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  FlightFrame last;
  for (int image = 0; image < 10; ++image) {
    Scene::feel(estimator, image);
    last = estimator.add(scene.observations(image));
  }
  EXPECT_TRUE(last.markers) << last.markers.reason;
  EXPECT_LT((last.state.T_world_body.translation() - Vector3d(0, 0, 1.5)).norm(), 1e-3);
  // Later than the filter's history reaches, they are refused.
  options.marker_delay_s = 0.7;
  FlightEstimator slow(options, kCamera, kBodyCam, scene.layout);
  for (int image = 0; image < 20; ++image) {
    Scene::feel(slow, image);
    last = slow.add(scene.observations(image));
  }
  EXPECT_EQ(last.markers.code, Code::kTooFewData);
}

TEST(FlightEstimator, RefusesImagesOfAnotherSizeOrOrderAndSamplesOutOfOrder) {
  const Scene scene;
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  Frame frame;
  frame.stamp_ns = kBegin_ns;
  frame.image = Image(100, 100, CV_8UC1, cv::Scalar(0));
  EXPECT_THROW((void)estimator.add(frame), ArgumentError);
  (void)estimator.add(scene.observations(1, false));
  EXPECT_THROW((void)estimator.add(scene.observations(1, false)), ArgumentError);
  Scene::feel(estimator, 2);
  EXPECT_EQ(estimator.add(ImuSample{kBegin_ns, {}, {}}).code, Code::kInconsistent);
  EXPECT_EQ(estimator.add(ImuSample{9 * kBegin_ns, Vector3d(NAN, 0, 0), {}}).code,
            Code::kInconsistent);
}

TEST(FlightEstimator, KeepsTheBiasesItKnowsWhereItBeginsAnew) {
  const Scene scene;
  FlightOptions options;
  options.marker_sensor.restart_after = 1;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  BodyState wrong;
  wrong.stamp_ns = kBegin_ns;
  wrong.T_world_body = SE3(SO3(), Vector3d(1, 0, 1.5));
  wrong.gyro_bias = {0, 0, 0.01};
  wrong.covariance.diagonal().setConstant(1e-8);
  Scene::feel(estimator, 0);
  estimator.start(wrong);
  FlightFrame frame;
  for (int image = 1; image <= 2; ++image) {
    Scene::feel(estimator, image);
    frame = estimator.add(scene.observations(image));
  }
  ASSERT_TRUE(frame.markers) << frame.markers.reason;
  EXPECT_NEAR(frame.state.T_world_body.translation().x(), 0, 1e-2);
  EXPECT_NEAR(frame.state.gyro_bias.z(), 0.01, 1e-3);
}

TEST(FlightEstimator, ForgetsThePosesOnTheWayWhereItStartsAnew) {
  const Scene scene;
  FlightOptions options;
  options.marker_delay_s = 0.1;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  for (int image = 0; image < 5; ++image) {
    Scene::feel(estimator, image);
    ASSERT_TRUE(estimator.add(scene.observations(image)).outcome);
  }
  BodyState state = estimator.at(kBegin_ns + 4 * kImage_ns).state;
  estimator.start(state);
  // A pose of before the start would be refused now, and this image's with it.
  for (int image = 5; image < 10; ++image) {
    Scene::feel(estimator, image);
    EXPECT_TRUE(estimator.add(scene.observations(image)).markers) << image;
  }
}

TEST(FlightEstimator, SaysWhereTheFilterRefusesALatePose) {
  const Scene scene;
  FlightOptions options;
  options.marker_delay_s = 0.1;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  const auto add = [&](int image, FlightMeasurements observations) {
    Scene::feel(estimator, image);
    return estimator.add(observations);
  };
  for (int image = 0; image < 4; ++image)
    ASSERT_TRUE(add(image, scene.observations(image)).markers);
  // An image shows the markers as if the body were 30 cm beside: its pose comes with the second
  // image after it.
  FlightMeasurements wrong = scene.observations(4);
  for (MarkerObservation& marker : wrong.markers)
    for (Vector2d& px : marker.corners_px) px.x() += 80;
  EXPECT_TRUE(add(4, wrong).markers);
  EXPECT_TRUE(add(5, scene.observations(5)).markers);
  EXPECT_EQ(add(6, scene.observations(6)).markers.code, Code::kInconsistent);
  EXPECT_TRUE(add(7, scene.observations(7)).markers);
}

TEST(FlightEstimator, TakesAFirstImageAtTimeZero) {
  FlightEstimator estimator({}, kCamera, kBodyCam, {});
  EXPECT_EQ(estimator.add(FlightMeasurements{}).markers.code, Code::kNotAttempted);
  EXPECT_THROW((void)estimator.add(FlightMeasurements{}), ArgumentError);
}

/// A body that slides along x and pitches: its specific force and the flow of the floor.
struct Pitching {
  static constexpr double kRate_rad_s = 0.2, kSpeed_mps = 0.4;

  static SE3 T_world_body(std::int64_t stamp_ns) {
    const double t = 1e-9 * static_cast<double>(stamp_ns - kBegin_ns);
    return SE3(SO3::exp({0, kRate_rad_s * t, 0}), Vector3d(kSpeed_mps * t, 0, 1.5));
  }
  static ImuSample sample(std::int64_t stamp_ns) {
    return {stamp_ns, Vector3d(0, kRate_rad_s, 0),
            T_world_body(stamp_ns).rotation().inverse() * Vector3d(-gravity())};
  }
  static FlightMeasurements observations(std::int64_t from_ns, std::int64_t to_ns) {
    FlightMeasurements result;
    result.stamp_ns = to_ns;
    const SE3 T_world_1 = T_world_body(from_ns) * kBodyCam;
    const SE3 T_2_world = (T_world_body(to_ns) * kBodyCam).inverse();
    for (double u = 100; u < 600; u += 80)
      for (double v = 80; v < 480; v += 80) {
        FlowVector vector;
        vector.kind = FlowVector::Kind::kFull;
        vector.px = {u, v};
        const Vector3d ray = T_world_1.rotation() * *kCamera.unproject(vector.px);
        const Vector3d camera_position = T_world_1.translation();
        const Vector3d point = camera_position - camera_position.z() / ray.z() * ray;
        vector.flow = *kCamera.project(T_2_world * point) - vector.px;
        vector.covariance = 0.01 * Eigen::Matrix2d::Identity();
        result.flow.push_back(vector);
      }
    return result;
  }
  /// At rest for all that it says, and unsure of that.
  static BodyState start() {
    BodyState state;
    state.stamp_ns = kBegin_ns;
    state.T_world_body = T_world_body(kBegin_ns);
    state.covariance.diagonal().setConstant(1e-6);
    state.covariance.diagonal().segment<3>(3).setConstant(1);
    return state;
  }
};

TEST(FlightEstimator, LearnsItsVelocityFromFlowWithoutTheRotationOfTheGyro) {
  FlightEstimator estimator({}, kCamera, kBodyCam, {});
  estimator.start(Pitching::start());
  FlightFrame last = estimator.add(FlightMeasurements{.stamp_ns = kBegin_ns});
  ASSERT_TRUE(last.outcome);
  for (std::int64_t now_ns = kBegin_ns + kImage_ns; now_ns <= kBegin_ns + 20 * kImage_ns;
       now_ns += kImage_ns) {
    for (std::int64_t at_ns = now_ns - kImage_ns + kSample_ns; at_ns <= now_ns; at_ns += kSample_ns)
      ASSERT_TRUE(estimator.add(Pitching::sample(at_ns)));
    last = estimator.add(Pitching::observations(now_ns - kImage_ns, now_ns));
    EXPECT_TRUE(last.flow) << last.flow.reason;
  }
  ASSERT_TRUE(last.outcome) << last.outcome.reason;
  // With its rotation in the flow, the velocity is wrong by rate times height: 0.3 m/s.
  EXPECT_LT((last.state.velocity_world - Vector3d(Pitching::kSpeed_mps, 0, 0)).norm(), 2e-2);
}

TEST(FlightEstimator, CatchesUpWithTheSamplesThatCameAfterTheStateItStartsWith) {
  FlightEstimator estimator({}, kCamera, kBodyCam, {});
  const std::int64_t now_ns = kBegin_ns + 2 * kImage_ns;
  for (std::int64_t at_ns = kBegin_ns - kImage_ns; at_ns <= now_ns; at_ns += kSample_ns)
    EXPECT_EQ(estimator.add(Pitching::sample(at_ns)).code, Code::kNotAttempted);
  estimator.start(Pitching::start());
  const ErrorStateFilter::StateEstimate now = estimator.at(now_ns);
  ASSERT_TRUE(now.outcome) << now.outcome.reason;
  const SO3 truth = Pitching::T_world_body(now_ns).rotation();
  EXPECT_LT((now.state.T_world_body.rotation().inverse() * truth).log().norm(), 1e-6);
}

TEST(FlightEstimator, StartsWithTheMarkersOfAnImageWhereItMayLookForThem) {
  const Camera camera = test::MarkerScene::usual_camera();
  const Scene scene;
  Random random = test::seeded_random(1);
  const SE3 T_world_body(SO3::exp({0.02, -0.03, 0.4}), Vector3d(0.1, 0.05, 1.4));
  Frame frame;
  frame.image = test::MarkerScene{.layout = scene.layout, .camera = camera, .samples = 3}.render(
      T_world_body * kBodyCam, random);
  FlightEstimator estimator({}, camera, kBodyCam, scene.layout);
  Scene::feel(estimator, 0);
  frame.stamp_ns = kBegin_ns;
  EXPECT_EQ(estimator.add(frame, false).outcome.code, Code::kNotAttempted);
  Scene::feel(estimator, 1);
  frame.stamp_ns += kImage_ns;
  const FlightFrame begun = estimator.add(frame);
  ASSERT_TRUE(begun.outcome) << begun.outcome.reason;
  EXPECT_EQ(begun.markers_seen, 3);
  // Corners are fitted to a tenth of a pixel, a third of a millimetre on the floor.
  EXPECT_LT((begun.state.T_world_body.translation() - T_world_body.translation()).norm(), 5e-3);
}

}  // namespace flight_estimator_test
}  // namespace placegraph
