#include <gtest/gtest.h>
#include <placegraph/pipeline/tracking/motion_model.h>

#include "tests/support/scenes/poses.h"

namespace placegraph {
namespace motion_model_test {

using namespace test;

const SE3 kStep(SO3::exp({0.01, 0.02, -0.03}), Eigen::Vector3d(0.1, 0, 0.5));
const SE3 kStart(SO3::exp({0.3, -0.2, 0.1}), Eigen::Vector3d(4, 5, 6));

TEST(MotionModel, ExpectsTheSameMotionAgain) {
  MotionModel motion(kStart);
  EXPECT_FALSE(motion.velocity_known());
  EXPECT_LT(difference(motion.predicted(), kStart), 1e-12);
  motion.update(kStart * kStep);
  EXPECT_TRUE(motion.velocity_known());
  EXPECT_LT(difference(motion.T_odom_cam(), kStart * kStep), 1e-12);
  EXPECT_LT(difference(motion.T_last_cur(), kStep), 1e-12);
  EXPECT_LT(difference(motion.predicted(), kStart * kStep * kStep), 1e-12);
}

TEST(MotionModel, ACorrectionMovesThePoseAndKeepsTheVelocity) {
  MotionModel motion(kStart, kStep);
  const SE3 corrected = kStart * SE3(SO3::exp({0, 0.1, 0}), Eigen::Vector3d(0, 0.2, 0));
  motion.correct(corrected);
  EXPECT_LT(difference(motion.predicted(), corrected * kStep), 1e-12);
}

TEST(MotionModel, AfterALossItStandsWhereItWas) {
  MotionModel motion(kStart, kStep);
  motion.forget_velocity();
  EXPECT_FALSE(motion.velocity_known());
  EXPECT_LT(difference(motion.predicted(), kStart), 1e-12);
}

TEST(MotionModel, AnotherUnitScalesTheTranslationOfTheVelocityAlone) {
  MotionModel motion(kStart, kStep);
  motion.rescale_velocity(3);
  EXPECT_LT((motion.T_last_cur().translation() - 3 * kStep.translation()).norm(), 1e-12);
  EXPECT_LT((motion.T_last_cur().rotation().inverse() * kStep.rotation()).log().norm(), 1e-12);
  EXPECT_LT(difference(motion.T_odom_cam(), kStart), 1e-12);
}

TEST(MotionModel, IsLessCertainTheFasterItGoes) {
  const MotionModel::Uncertainty uncertainty{0.02, 0.5, 0.04};
  const double median_depth = 10;
  const Matrix6d still = MotionModel(kStart).information(uncertainty, median_depth);
  EXPECT_NEAR(still(0, 0), 1 / (0.2 * 0.2), 1e-9);  // 0.02 * 10
  EXPECT_NEAR(still(5, 5), 1 / (0.04 * 0.04), 1e-9);
  EXPECT_EQ(still(0, 3), 0);
  const SE3 metre(SO3(), Eigen::Vector3d(0, 0, 1));
  const Matrix6d moving = MotionModel(kStart, metre).information(uncertainty, median_depth);
  EXPECT_NEAR(moving(2, 2), 1 / (0.7 * 0.7), 1e-9);  // 0.02 * 10 + 0.5 * 1
}

TEST(MotionModel, LawAnotherOdometryFrameChangesThePredictionByThatFrameAlone) {
  const SE3 T_other_odom(SO3::exp({-0.4, 1.1, 0.2}), Eigen::Vector3d(-7, 2, 30));
  MotionModel here(kStart), there(T_other_odom * kStart);
  here.update(kStart * kStep);
  there.update(T_other_odom * (kStart * kStep));
  EXPECT_LT(difference(there.predicted(), T_other_odom * here.predicted()), 1e-12);
}

}  // namespace motion_model_test
}  // namespace placegraph
