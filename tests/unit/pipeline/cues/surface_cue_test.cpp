#include <gtest/gtest.h>
#include <placegraph/pipeline/cues/surface_cue.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace {

using namespace test;
using Code = Outcome::Code;

const StreetDataset& street_frames() {
  static const StreetDataset dataset(2);
  return dataset;
}

SE3 true_step() { return street_T_world_cam(0).inverse() * street_T_world_cam(1); }

SurfaceCue cue_of(bool several) {
  Calibration calibration = street_frames().calibration(Sensor::kStereo);
  if (!several) calibration.camera_height_m = kStreetHeight_m;
  return SurfaceCue({}, calibration, {}, several);
}

TEST(SurfaceCue, TheGroundTellsAStepAndConfirmsItFromBothEnds) {
  Random random(1);
  SurfaceCue cue = cue_of(false);
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

TEST(SurfaceCue, AContradictionIsSaidAndCountsInTheCovariance) {
  Random random(1);
  SurfaceCue cue = cue_of(false);
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

TEST(SurfaceCue, SeveralPlanesAreFoundAtOnce) {
  Random random(1);
  SurfaceCue cue = cue_of(true);
  cue.see(street_frames().frame(0, Sensor::kStereo));
  ASSERT_TRUE(cue.become_reference(SE3(), {}, {}, random));
  cue.see(street_frames().frame(1, Sensor::kStereo));
  const DirectMotion motion = cue.align({SE3(SO3(), Eigen::Vector3d(0, 0, 0.3))});
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_GE(motion.planes.size(), 2u);
  EXPECT_LT((true_step().inverse() * motion.T_ref_cur).log().norm(), 0.02);
}

TEST(SurfaceCue, WithoutASurfaceThereIsNoReferenceAndNoMotion) {
  Random random(1);
  SurfaceCue cue = cue_of(true);
  Frame blind = street_frames().frame(0, Sensor::kStereo);
  blind.right = Image(blind.right.size(), CV_8UC1, cv::Scalar(0));
  cue.see(blind);
  EXPECT_FALSE(cue.become_reference(SE3(), {}, {}, random));
  EXPECT_FALSE(cue.has_reference());
  EXPECT_EQ(cue.align({SE3()}).outcome.code, Code::kTooFewData);
}

}  // namespace
}  // namespace placegraph
