#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/flight_estimator.h>

#include <cmath>
#include <numbers>

namespace placegraph {
namespace {

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
  HoverSights sights(int image, bool markers = true) const {
    HoverSights result;
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
      MarkerSighting sighting;
      sighting.id = marker.id;
      sighting.covariance *= 0.01;
      const auto corners = marker.corners_marker();
      for (std::size_t i = 0; i < 4; ++i)
        sighting.corners_px[i] = seen(marker.T_world_marker * corners[i], result.stamp_ns);
      result.markers.push_back(sighting);
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
  EXPECT_EQ(estimator.add(scene.sights(0, false)).outcome.code, Code::kNotAttempted);
  Scene::feel(estimator, 1);
  const HoverFrame begun = estimator.add(scene.sights(1));
  ASSERT_TRUE(begun.outcome) << begun.outcome.reason;
  EXPECT_LT((begun.state.T_world_body.translation() - Vector3d(0, 0, 1.5)).norm(), 1e-3);
}

TEST(FlightEstimator, DoesNotBeginWithoutItsInertialSensor) {
  const Scene scene;
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  const HoverFrame frame = estimator.add(scene.sights(0));
  EXPECT_EQ(frame.outcome.code, Code::kNotAttempted);
  EXPECT_EQ(frame.markers.code, Code::kTooFewData);
}

TEST(FlightEstimator, GoesOnByFlowWhereNoMarkerIsSeen) {
  const Scene scene{.speed_mps = 0.5};
  FlightEstimator estimator({}, kCamera, kBodyCam, scene.layout);
  HoverFrame last;
  for (int image = 0; image < 20; ++image) {
    Scene::feel(estimator, image);
    last = estimator.add(scene.sights(image, image < 5));
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
  HoverFrame last;
  for (int image = 0; image < 20; ++image) {
    if (image < 5) Scene::feel(estimator, image);
    last = estimator.add(scene.sights(image));
    if (image < 5) {
      ASSERT_TRUE(last.outcome);
    }
  }
  EXPECT_FALSE(last.outcome);
}

TEST(FlightEstimator, BeginsAnewWhereMarkersContradictItPersistently) {
  const Scene scene;
  HoverOptions options;
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
    const HoverFrame frame = estimator.add(scene.sights(image));
    ASSERT_TRUE(frame.outcome);
    EXPECT_EQ(static_cast<bool>(frame.markers), image > 3) << image;
    EXPECT_NEAR(frame.state.T_world_body.translation().x(), image > 3 ? 0 : 1, 1e-2) << image;
  }
}

TEST(FlightEstimator, TakesMarkersThatComeLate) {
  const Scene scene;
  HoverOptions options;
  options.marker_delay_s = 0.1;
  FlightEstimator estimator(options, kCamera, kBodyCam, scene.layout);
  HoverFrame last;
  for (int image = 0; image < 10; ++image) {
    Scene::feel(estimator, image);
    last = estimator.add(scene.sights(image));
  }
  EXPECT_TRUE(last.markers) << last.markers.reason;
  EXPECT_LT((last.state.T_world_body.translation() - Vector3d(0, 0, 1.5)).norm(), 1e-3);
  // Later than the filter's history reaches, they are refused.
  options.marker_delay_s = 0.7;
  FlightEstimator slow(options, kCamera, kBodyCam, scene.layout);
  for (int image = 0; image < 20; ++image) {
    Scene::feel(slow, image);
    last = slow.add(scene.sights(image));
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
  (void)estimator.add(scene.sights(1, false));
  EXPECT_THROW((void)estimator.add(scene.sights(1, false)), ArgumentError);
  Scene::feel(estimator, 2);
  EXPECT_EQ(estimator.add(ImuSample{kBegin_ns, {}, {}}).code, Code::kInconsistent);
  EXPECT_EQ(estimator.add(ImuSample{9 * kBegin_ns, Vector3d(NAN, 0, 0), {}}).code,
            Code::kInconsistent);
}

}  // namespace
}  // namespace placegraph
