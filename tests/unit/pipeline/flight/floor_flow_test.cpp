#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/floor_flow.h>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace floor_flow_test {

using Code = Outcome::Code;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFloor_m = 3;
const Camera kCamera{.width = 320, .height = 240, .fx = 220, .fy = 220, .cx = 159.5, .cy = 119.5};
/// Looks down, mounted beside the middle of the body and tilted a little.
const SE3 kBodyCam(SO3::exp({3.0, 0.1, 0}), Vector3d(0.1, -0.05, 0.02));

BodyState body(const SE3& T_world_body, std::int64_t stamp_ns = 0) {
  BodyState state;
  state.stamp_ns = stamp_ns;
  state.T_world_body = T_world_body;
  return state;
}

Image picture(const BodyState& state) {
  const test::TexturedPlane floor{.T_world_plane = SE3(SO3(), Vector3d(0, 0, kFloor_m)),
                                  .texture = {.seed = 3, .wavelength = 0.3}};
  return test::render(kCamera, state.T_world_body * kBodyCam, {floor}).grey;
}

/// Where a point of the floor that is at `px` in the image of `a` is in that of `b`.
Vector2d moved_px(const Vector2d& px, const BodyState& a, const BodyState& b) {
  const SE3 T_world_cam = a.T_world_body * kBodyCam;
  const Vector3d ray = T_world_cam.rotation() * *kCamera.unproject(px);
  const Vector3d camera_position = T_world_cam.translation();
  const Vector3d point = camera_position + (kFloor_m - camera_position.z()) / ray.z() * ray;
  return *kCamera.project((b.T_world_body * kBodyCam).inverse() * point);
}

FloorFlow floor_flow(const FloorFlowOptions& options = {}) {
  return {options, kCamera, kBodyCam, kFloor_m};
}

/// The number of vectors whose flow is within `max_px` of the true one.
int right_vectors(const std::vector<FlowVector>& flow, const BodyState& a, const BodyState& b,
                  double max_px) {
  int right = 0;
  for (const FlowVector& vector : flow)
    right += (vector.px + vector.flow - moved_px(vector.px, a, b)).norm() < max_px;
  return right;
}

const SE3 kFirst(SO3::exp({0.03, -0.02, 0.2}), Vector3d(0.3, 0.2, 4.5));

TEST(FloorFlow, TracksTheFloorFromOneImageToTheNext) {
  const BodyState a = body(kFirst);
  const BodyState b = body(SE3(kFirst.rotation() * SO3::exp({0.01, 0.01, 0.02}),
                               Vector3d(kFirst.translation() + Vector3d(0.03, -0.02, 0.01))));
  FloorFlow flow = floor_flow();
  StageTimes times;
  EXPECT_TRUE(flow.track(picture(a), std::nullopt, std::nullopt, times).empty());
  const std::vector<FlowVector> vectors = flow.track(picture(b), std::nullopt, std::nullopt, times);
  ASSERT_GT(vectors.size(), 60u);
  // Grey values are rounded: a few hundredths of a pixel are usual.
  EXPECT_GT(right_vectors(vectors, a, b, 0.2), 0.9 * static_cast<double>(vectors.size()));
}

/// The motion moves points by some 30 px, farther than is searched near a prediction, and rotates
/// the windows of the tracks, which costs half a pixel.
TEST(FloorFlow, SearchesNearWhereTheStatesPutTheFloor) {
  const BodyState a = body(kFirst);
  const BodyState b = body(SE3(kFirst.rotation() * SO3::exp({0.03, 0.03, 0.1}),
                               Vector3d(kFirst.translation() + Vector3d(0.2, -0.15, 0.1))));
  const auto tracked = [&](const BodyState& expected) {
    FloorFlow flow = floor_flow();
    StageTimes times;
    (void)flow.track(picture(a), std::nullopt, std::nullopt, times);
    return right_vectors(flow.track(picture(b), a, expected, times), a, b, 1);
  };
  const int near_truth = tracked(b), near_the_old_place = tracked(a);
  EXPECT_GT(near_truth, 50);
  EXPECT_LT(near_the_old_place, 15);  // those that moved the least
}

TEST(FloorFlow, TakesTheNoiseOfAPointIntoTheCovarianceOfItsFlow) {
  const BodyState a = body(kFirst);
  const Image image = picture(a);
  const auto covariances = [&](double noise_px) {
    FloorFlow flow = floor_flow({.noise_px = noise_px});
    StageTimes times;
    (void)flow.track(image, std::nullopt, std::nullopt, times);
    return flow.track(image, std::nullopt, std::nullopt, times);
  };
  const std::vector<FlowVector> none = covariances(0), some = covariances(0.5);
  ASSERT_EQ(none.size(), some.size());
  ASSERT_FALSE(none.empty());
  for (std::size_t i = 0; i < none.size(); ++i) {
    EXPECT_GT(none[i].covariance.determinant(), 0);
    const Eigen::Matrix2d more = some[i].covariance - none[i].covariance;
    EXPECT_LT((more - 0.25 * Eigen::Matrix2d::Identity()).norm(), 1e-12);
  }
}

/// The images at which corners are detected.
std::vector<int> detections(FloorFlow& flow, const std::vector<Image>& images) {
  StageTimes times;
  std::vector<int> at;
  std::int64_t calls = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    (void)flow.track(images[i], std::nullopt, std::nullopt, times);
    for (const StageTime& stage : times.stages()) {
      if (stage.name != "detect corners" || stage.calls == calls) continue;
      calls = stage.calls;
      at.push_back(static_cast<int>(i));
    }
  }
  return at;
}

TEST(FloorFlow, DetectsCornersAgainOnlyWhereTracksAreLost) {
  const Image textured = picture(body(kFirst)), plain(240, 320, CV_8UC1, cv::Scalar(128));
  FloorFlow on_texture = floor_flow({.tracker = {.max_tracks = 60, .max_anchor_shift_px = 0}});
  EXPECT_EQ(detections(on_texture, std::vector<Image>(12, textured)), std::vector<int>{0});
  // A floor without corners is searched in every fifth image.
  FloorFlow on_plain = floor_flow();
  EXPECT_EQ(detections(on_plain, std::vector<Image>(12, plain)), (std::vector<int>{0, 5, 10}));
  // Tracks that are lost are replaced in the second image after the last detection.
  std::vector<Image> images(12, plain);
  images[0] = textured;
  FloorFlow on_both = floor_flow();
  EXPECT_EQ(detections(on_both, images), (std::vector<int>{0, 2, 7}));
}

TEST(FloorFlow, RefusesImagesOfAnotherSizeAndOptionsOutOfRange) {
  FloorFlow flow = floor_flow();
  StageTimes times;
  EXPECT_THROW(
      (void)flow.track(Image(240, 240, CV_8UC1, cv::Scalar(0)), std::nullopt, std::nullopt, times),
      ArgumentError);
  EXPECT_THROW((void)floor_flow({.min_points = 2}), ArgumentError);
  EXPECT_THROW((void)floor_flow({.tracker = {.window_px = 4}}), ArgumentError);
}

/// Exact flow of points of the floor.
std::vector<FlowVector> exact_flow(const BodyState& a, const BodyState& b) {
  std::vector<FlowVector> flow;
  for (double u = 30; u < 300; u += 40)
    for (double v = 30; v < 220; v += 40) {
      FlowVector vector;
      vector.kind = FlowVector::Kind::kFull;
      vector.px = {u, v};
      vector.flow = moved_px(vector.px, a, b) - vector.px;
      vector.covariance = 0.01 * Eigen::Matrix2d::Identity();
      flow.push_back(vector);
    }
  return flow;
}

/// A body that flies tilted, and the rotation of its camera as a gyro tells it.
struct Step {
  BodyState a = body(SE3(SO3::exp({0.2, -0.15, 0.7}), Vector3d(0.3, 0.2, 4.5)), 1000);
  BodyState b = body(
      SE3(a.T_world_body.rotation() * SO3::exp({0.02, 0.03, -0.04}), Vector3d(0.38, 0.15, 4.55)),
      51'000'000);
  KnownRotation rotation;
  std::vector<FlowVector> flow = exact_flow(a, b);

  Step() {
    a.gyro_bias = {0.01, 0.02, 0.03};
    rotation.R_1_2 = T_1_2().rotation();
  }
  SE3 T_1_2() const { return (a.T_world_body * kBodyCam).inverse() * (b.T_world_body * kBodyCam); }
};

TEST(FloorFlow, MeasuresTheCamerasTranslationOverItsHeight) {
  const Step step;
  const FloorFlowMeasurement found =
      floor_flow().measure(step.flow, step.a, step.b.stamp_ns, step.rotation);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_EQ(found.inliers, static_cast<int>(step.flow.size()));
  EXPECT_LT(found.chi2_per_dof, 1e-6);
  ASSERT_TRUE(found.observation);
  const double height = (step.a.T_world_body * kBodyCam).translation().z() - kFloor_m;
  const Vector3d expected = step.T_1_2().translation() / height;
  EXPECT_LT((found.observation->over_distance - expected).norm(), 1e-6);
  EXPECT_EQ(found.observation->from_ns, 1000);
  EXPECT_EQ(found.observation->to_ns, 51'000'000);
  EXPECT_EQ(found.observation->gyro_bias, step.a.gyro_bias);
  EXPECT_LT((found.observation->R_from_to.inverse() * step.rotation.R_1_2).log().norm(), 1e-12);
  ASSERT_TRUE(found.observation->J_rotation);
}

/// What the measurement says of a wrong rotation: its Jacobian against a rotation that is wrong by
/// a hundred thousandth. The Jacobian holds to a few percent: it leaves out how the equations of
/// the flow themselves depend on the rotation.
TEST(FloorFlow, TellsHowAWrongRotationChangesTheMeasurement) {
  const Step step;
  const FloorFlow flow = floor_flow();
  const FlowMeasurement exact =
      *flow.measure(step.flow, step.a, step.b.stamp_ns, step.rotation).observation;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d wrong = 1e-5 * Vector3d::Unit(axis);
    const KnownRotation rotation{step.rotation.R_1_2 * SO3::exp(wrong), Matrix3d::Zero()};
    const FlowMeasurement found =
        *flow.measure(step.flow, step.a, step.b.stamp_ns, rotation).observation;
    const Vector3d change = found.over_distance - exact.over_distance;
    EXPECT_LT((change - *exact.J_rotation * wrong).norm(), 0.05 * wrong.norm()) << axis;
  }
}

TEST(FloorFlow, AddsTheErrorCommonToAllVectors) {
  const Step step;
  const auto covariance = [&](double common_px) {
    return Matrix3d(floor_flow({.common_px = common_px})
                        .measure(step.flow, step.a, step.b.stamp_ns, step.rotation)
                        .observation->covariance);
  };
  const double sigma = 0.5 / kCamera.fx;
  EXPECT_LT((covariance(0.5) - covariance(0) - sigma * sigma * Matrix3d::Identity()).norm(), 1e-12);
}

TEST(FloorFlow, SaysWhyThereIsNoMeasurement) {
  Step step;
  const auto measured = [&](const FloorFlowOptions& options,
                            const std::optional<BodyState>& previous) {
    return floor_flow(options).measure(step.flow, previous, step.b.stamp_ns, step.rotation);
  };
  EXPECT_EQ(measured({}, std::nullopt).outcome.code, Code::kNotAttempted);
  step.flow.resize(11);
  const FloorFlowMeasurement few = measured({}, step.a);
  EXPECT_EQ(few.outcome.code, Code::kTooFewData);
  EXPECT_EQ(few.inliers, 11);
  EXPECT_FALSE(few.observation);
  EXPECT_TRUE(measured({.min_points = 11}, step.a).observation);
  const FloorFlowMeasurement disabled = measured({.min_points = 11, .enabled = false}, step.a);
  EXPECT_TRUE(disabled.outcome);
  EXPECT_FALSE(disabled.observation);
}

}  // namespace floor_flow_test
}  // namespace placegraph
