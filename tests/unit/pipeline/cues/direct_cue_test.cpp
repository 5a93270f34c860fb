#include <gtest/gtest.h>
#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/cues/direct_cue.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace direct_cue_test {

using namespace test;
using Code = Outcome::Code;

const StreetDataset& street_frames() {
  static const StreetDataset dataset(2);
  return dataset;
}

SE3 true_step() { return street_T_world_cam(0).inverse() * street_T_world_cam(1); }

DirectCue cue_of(bool several) {
  Calibration calibration = street_frames().calibration(Sensor::kStereo);
  if (!several) calibration.camera_height_m = kStreetHeight_m;
  return DirectCue({}, calibration, {}, several);
}

TEST(DirectCue, TheGroundTellsAStepAndConfirmsItFromBothEnds) {
  Random random(1);
  DirectCue cue = cue_of(false);
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  // Road between two and twelve heights ahead, most of its pixels near.
  EXPECT_GT(cue.median_depth_m(), 2 * kStreetHeight_m);
  EXPECT_LT(cue.median_depth_m(), 8 * kStreetHeight_m);
  cue.see(street_frames().frame(1, Sensor::kStereo));
  const DirectMotion forward = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
  ASSERT_TRUE(forward.outcome) << forward.outcome.reason;
  EXPECT_LT((true_step().inverse() * forward.T_ref_cur).log().norm(), 0.02);
  EXPECT_FALSE(cue.view(forward).empty());
  ASSERT_TRUE(cue.become_reference(forward.T_ref_cur, {}, {}, random));
  const DirectMotion both = cue.confirm(forward);
  EXPECT_TRUE(both.outcome) << both.outcome.reason;
  EXPECT_LT((true_step().inverse() * both.T_ref_cur).log().norm(), 0.02);
}

TEST(DirectCue, AContradictionIsSaidAndCountsInTheCovariance) {
  Random random(1);
  DirectCue cue = cue_of(false);
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(street_frames().frame(1, Sensor::kStereo));
  DirectMotion wrong = cue.align({true_step()});
  ASSERT_TRUE(wrong.outcome);
  wrong.T_ref_cur = wrong.T_ref_cur * SE3(SO3(), Eigen::Vector3d(0.1, 0, 0));
  wrong.covariance *= 1e-4;
  ASSERT_TRUE(cue.become_reference(true_step(), {}, {}, random));
  const DirectMotion both = cue.confirm(wrong);
  EXPECT_EQ(both.outcome.code, Code::kInconsistent);
  EXPECT_GT(both.covariance(0, 0), 0.05 * 0.05);
}

TEST(DirectCue, SeveralPlanesAreFoundAtOnce) {
  Random random(1);
  DirectCue cue = cue_of(true);
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(street_frames().frame(1, Sensor::kStereo));
  const DirectMotion motion = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_GE(motion.planes.size(), 2u);
  EXPECT_LT((true_step().inverse() * motion.T_ref_cur).log().norm(), 0.02);
}

TEST(DirectCue, WithoutASurfaceThereIsNoReferenceAndNoMotion) {
  Random random(1);
  DirectCue cue = cue_of(true);
  Frame blind = street_frames().frame(0, Sensor::kStereo);
  blind.right = Image(blind.right.size(), CV_8UC1, cv::Scalar(0));
  cue.see(blind);
  EXPECT_FALSE(cue.become_reference(SE3(), {}, {}, random));
  EXPECT_FALSE(cue.has_reference());
  EXPECT_EQ(cue.align({SE3()}).outcome.code, Code::kTooFewData);
}

TEST(DirectCue, ASingleCameraOfKnownHeightAlignsByTheGround) {
  Random random(1);
  Calibration calibration = street_frames().calibration(Sensor::kMono);
  calibration.camera_height_m = kStreetHeight_m;
  DirectCue cue({}, calibration, {}, false);
  cue.see(street_frames().frame(0, Sensor::kMono));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(street_frames().frame(1, Sensor::kMono));
  const DirectMotion motion = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT((true_step().inverse() * motion.T_ref_cur).log().norm(), 0.03);
  // Twice as high, the same images are those of twice the way.
  calibration.camera_height_m = 2 * kStreetHeight_m;
  DirectCue higher({}, calibration, {}, false);
  higher.see(street_frames().frame(0, Sensor::kMono));
  ASSERT_TRUE(higher.become_reference(SE3(), {}, {}, random));
  higher.see(street_frames().frame(1, Sensor::kMono));
  const DirectMotion longer = higher.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.6))});
  ASSERT_TRUE(longer.outcome);
  EXPECT_NEAR(longer.T_ref_cur.translation().norm() / motion.T_ref_cur.translation().norm(), 2,
              0.01);
}

TEST(DirectCue, ASingleCameraLearnsHowItIsMounted) {
  // It looks up by two degrees, which nothing has told it.
  const SE3 T_level_cam = pose({0.035, 0, 0}, {0, 0, 0});
  const StreetDataset tilted(2, 0, 0, false,
                             [&](int i) { return street_T_world_cam(i) * T_level_cam; });
  Calibration calibration = tilted.calibration(Sensor::kMono);
  calibration.camera_height_m = kStreetHeight_m;
  DirectCue cue({}, calibration, {}, false);
  Random random(1);
  const double true_length_m = true_step().translation().norm();
  std::vector<double> depths_m;
  for (int round = 0; round < 3; ++round) {
    cue.see(tilted.frame(0, Sensor::kMono));
    ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
    depths_m.push_back(cue.median_depth_m());
    cue.see(tilted.frame(1, Sensor::kMono));
    const DirectMotion motion = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
    ASSERT_TRUE(motion.outcome) << round << motion.outcome.reason;
    EXPECT_NEAR(motion.T_ref_cur.translation().norm(), true_length_m,
                3 * std::sqrt(motion.covariance(2, 2)));
    cue.learn(motion);
  }
  // The median depth of the road ahead for a camera whose mounting is known.
  const Eigen::Vector3d normal = T_level_cam.rotation().inverse() * Eigen::Vector3d::UnitY();
  const DominantSurface road(DirectCueOptions().surface, calibration.camera,
                             Plane{normal, kStreetHeight_m});
  std::vector<double> truth_m;
  for (const Eigen::Vector2f& px : road.pixels_of(SurfaceRegion::kAhead, {}))
    truth_m.push_back(kStreetHeight_m /
                      normal.dot(*calibration.camera.unproject(px.cast<double>())));
  const double median_m = median_of(truth_m);
  EXPECT_LT(depths_m[0], 0.95 * median_m);  // what looks up takes the road to be nearer
  // Pixels of the median depth lie 1.65 m / 5.9 m = 0.28 rad below the horizon; a pitch that is
  // known to 2 mrad tells their depth to 0.7 %.
  EXPECT_NEAR(depths_m[1], median_m, 0.007 * median_m);
  EXPECT_NEAR(depths_m[2], median_m, 0.007 * median_m);
}

TEST(DirectCue, LandmarksShowASingleCameraOtherPlanes) {
  Random random(1);
  Calibration calibration = street_frames().calibration(Sensor::kMono);
  calibration.camera_height_m = kStreetHeight_m;
  DirectCue cue({}, calibration, {}, true);
  cue.see(street_frames().frame(0, Sensor::kMono));
  // Points on the wall at the end of the street, 32 m ahead.
  std::vector<KnownPixel> landmarks;
  const double depth = 32;
  for (double x = -4; x <= 4; x += 0.5)
    for (double y = -7; y < 0; y += 0.5) {
      const Eigen::Vector3d p = street_T_world_cam(0).inverse() * Eigen::Vector3d(x, y, depth);
      KnownPixel known;
      known.px = street_camera().project(p)->cast<float>();
      known.depth = {p / p.z(), 1 / p.z(), 0.03 / p.z()};
      landmarks.push_back(known);
    }
  ASSERT_TRUE(cue.become_reference(SE3(), {}, landmarks, random));
  cue.see(street_frames().frame(1, Sensor::kMono));
  const DirectMotion motion = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
  ASSERT_TRUE(motion.outcome);
  ASSERT_EQ(motion.planes.size(), 2u);
  EXPECT_NEAR(1 / motion.planes[1].g_ref.norm(), depth, 0.1 * depth);
}

TEST(DirectCue, ASearchBeginsWhereNoGuessLeads) {
  Random random(1);
  DirectCue cue = cue_of(false);
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(street_frames().frame(1, Sensor::kStereo));
  Vector6d sigmas;
  sigmas << 0.1, 0.1, 0.5, 0.01, 0.02, 0.01;
  MotionGuess guess{SE3()};
  guess.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  const DirectMotion motion = cue.search(guess, sigmas);
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT((true_step().inverse() * motion.T_ref_cur).log().norm(), 0.05);
}

TEST(DirectCue, TheGroundIsOnlyWhereItsMaskAllowsIt) {
  Random random(1);
  Calibration calibration = street_frames().calibration(Sensor::kMono);
  calibration.camera_height_m = kStreetHeight_m;
  DirectCue cue({}, calibration, {}, false);
  const Frame frame = street_frames().frame(0, Sensor::kMono);
  Image left(frame.image.size(), CV_8UC1, cv::Scalar(0));
  left.colRange(0, left.cols / 2).setTo(255);
  cue.see(frame);
  cue.restrict_ground(left);
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(frame);
  const DirectMotion motion = cue.align({SE3()});
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  ASSERT_FALSE(motion.seen.empty());
  for (const FrameView::SurfacePixel& pixel : cue.view(motion))
    EXPECT_LT(pixel.px.x(), left.cols / 2.0 + 8);  // what lies near a pixel counts with it
}

TEST(DirectCue, AResetForgetsTheReference) {
  Random random(1);
  DirectCue cue = cue_of(false);
  EXPECT_EQ(cue.median_depth_m(), 10);  // nothing is known
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  EXPECT_TRUE(cue.has_reference());
  cue.reset();
  EXPECT_FALSE(cue.has_reference());
  cue.see(street_frames().frame(1, Sensor::kStereo));
  EXPECT_EQ(cue.align({SE3()}).outcome.code, Code::kTooFewData);
  EXPECT_EQ(cue.search({SE3()}, Vector6d::Ones()).outcome.code, Code::kTooFewData);
}

}  // namespace direct_cue_test
}  // namespace placegraph
