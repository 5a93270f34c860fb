#include <gtest/gtest.h>
#include <placegraph/pipeline/cues/keyframe_alignment.h>

#include <Eigen/Eigenvalues>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace keyframe_alignment_test {

using namespace test;

const StreetDataset& drive() {
  static const StreetDataset dataset(3);
  return dataset;
}
SE3 true_step() { return street_T_world_cam(0).inverse() * street_T_world_cam(1); }

struct Alignment {
  Calibration calibration;
  KeyframeAlignment alignment;
  SlidingWindow window;
  Random random{1};

  explicit Alignment(Sensor sensor = Sensor::kStereo)
      : calibration(with_height(sensor)),
        alignment({}, calibration, {}),
        window({}, calibration.camera) {}
  static Calibration with_height(Sensor sensor) {
    Calibration calibration = drive().calibration(sensor);
    calibration.camera_height_m = kStreetHeight_m;
    return calibration;
  }
  /// Frame `i` becomes keyframe `i`, thought to stand at T_odom_cam.
  void add(int i, const SE3& T_odom_cam, std::optional<KeyframeId> previous, Sensor sensor,
           const Image& ground = {}) {
    window.add_keyframe(KeyframeId(i), T_odom_cam);
    alignment.add({KeyframeId(i), drive().frame(static_cast<std::size_t>(i), sensor), ground, {}},
                  previous, {}, window, random);
  }
  /// What the factor says of the motion, as the window's optimum has it.
  SE3 optimum() {
    EXPECT_TRUE(window.optimize().outcome);
    return window.pose(KeyframeId(0)).inverse() * window.pose(KeyframeId(1));
  }
};
double error(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(KeyframeAlignment, TheMotionBetweenTwoKeyframesIsAFactorOfTheWindow) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  EXPECT_TRUE(a.window.factors().empty());
  EXPECT_TRUE(a.alignment.view().empty());
  const SE3 off(SO3::exp({0, 0.01, 0}), Eigen::Vector3d(0.02, 0.01, 0.05));
  a.add(1, true_step() * off, KeyframeId(0), Sensor::kStereo);
  ASSERT_EQ(a.window.factors().size(), 1u);
  EXPECT_FALSE(a.alignment.view().empty());
  // The keyframe moves to where the surfaces have it.
  EXPECT_LT(error(a.optimum(), true_step()), 0.02);
}

TEST(KeyframeAlignment, ASegmentBeginsWithoutMotion) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  a.add(1, true_step(), std::nullopt, Sensor::kStereo);
  EXPECT_TRUE(a.window.factors().empty());
  // The second one is the reference of the third.
  a.add(2, street_T_world_cam(0).inverse() * street_T_world_cam(2), KeyframeId(1), Sensor::kStereo);
  ASSERT_EQ(a.window.factors().size(), 1u);
  EXPECT_EQ(a.window.factors()[0].variables,
            (std::vector{keyframe_variable(KeyframeId(1)), keyframe_variable(KeyframeId(2))}));
}

TEST(KeyframeAlignment, WhatWasAlignedBeforeANewSegmentIsNotShownOn) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  a.add(1, true_step(), KeyframeId(0), Sensor::kStereo);
  ASSERT_FALSE(a.alignment.view().empty());
  a.add(2, street_T_world_cam(0).inverse() * street_T_world_cam(2), std::nullopt, Sensor::kStereo);
  EXPECT_TRUE(a.alignment.view().empty());
  EXPECT_EQ(a.window.factors().size(), 1u);
}

TEST(KeyframeAlignment, AResetForgetsTheReference) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  a.alignment.reset();
  a.add(1, true_step(), KeyframeId(0), Sensor::kStereo);
  EXPECT_TRUE(a.window.factors().empty());
}

TEST(KeyframeAlignment, WhatWasAlignedLastIsForgottenWhereAskedFor) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  a.add(1, true_step(), KeyframeId(0), Sensor::kStereo);
  ASSERT_FALSE(a.alignment.view().empty());
  a.alignment.forget_newest();
  EXPECT_TRUE(a.alignment.view().empty());
}

/// Deviation of the length of the motion from keyframe 0 to 1, by its factor alone.
double sigma_of_length(const SlidingWindow& window) {
  const SE3 T = window.pose(KeyframeId(0)).inverse() * window.pose(KeyframeId(1));
  const Matrix6d information = relative_information(window, KeyframeId(0), KeyframeId(1));
  const Matrix6d covariance = information.inverse();
  const Eigen::Vector3d along = T.rotation().inverse() * T.translation().normalized();
  return std::sqrt(along.dot(covariance.topLeftCorner<3, 3>() * along));
}

TEST(KeyframeAlignment, ASingleCameraDoesNotCountItsHeightTwice) {
  Alignment stereo, mono(Sensor::kMono);
  for (Alignment* a : {&stereo, &mono}) {
    const Sensor sensor = a == &mono ? Sensor::kMono : Sensor::kStereo;
    a->add(0, SE3(), std::nullopt, sensor);
    a->add(1, true_step(), KeyframeId(0), sensor);
    ASSERT_EQ(a->window.factors().size(), 1u);
    EXPECT_LT(error(a->optimum(), true_step()), 0.03);
  }
  const double length = true_step().translation().norm();
  EXPECT_LT(sigma_of_length(stereo.window), 0.1 * length);
  // As if it were known to its own size: landmarks give the length.
  EXPECT_GT(sigma_of_length(mono.window), 0.9 * length);
}

TEST(KeyframeAlignment, WithoutSurfacesThereIsNoMotion) {
  Alignment a;
  a.add(0, SE3(), std::nullopt, Sensor::kStereo);
  a.window.add_keyframe(KeyframeId(1), true_step());
  Frame dark = drive().frame(1, Sensor::kStereo);
  dark.image = dark.right = Image(dark.image.size(), CV_8UC1, cv::Scalar(0));
  a.alignment.add({KeyframeId(1), dark, {}, {}}, KeyframeId(0), {}, a.window, a.random);
  EXPECT_TRUE(a.window.factors().empty());
}

}  // namespace keyframe_alignment_test
}  // namespace placegraph
