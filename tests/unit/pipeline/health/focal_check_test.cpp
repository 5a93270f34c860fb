#include <gtest/gtest.h>
#include <placegraph/pipeline/internal/health/focal_check.h>

#include <cmath>

namespace placegraph {
namespace {

Calibration mono() {
  Calibration calibration;
  calibration.camera.fx = calibration.camera.fy = 700;
  return calibration;
}

/// Of a window that says s, to `sigma`, and nothing of the distortion.
FocalEvidence window_of(double s, double sigma) {
  FocalEvidence evidence;
  evidence.information(0, 0) = 1 / (sigma * sigma);
  evidence.gradient[0] = -s * evidence.information(0, 0);
  return evidence;
}

TEST(FocalCheck, IsTheWeightedMeanOfItsWindows) {
  FocalCheck check(mono());
  EXPECT_TRUE(std::isinf(check.estimate().sigma));
  check.add(window_of(0.10, 0.001));
  EXPECT_NEAR(check.estimate().error, 0.10, 1e-12);
  EXPECT_NEAR(check.estimate().sigma, 0.02, 1e-3);  // a window's own error
  check.add(window_of(0.13, 1));
  EXPECT_NEAR(check.estimate().error, 0.10, 1e-3);
  for (int i = 0; i < 24; ++i) check.add(window_of(0.10, 0.001));
  EXPECT_NEAR(check.estimate().sigma, 0.004, 1e-3);
}

TEST(FocalCheck, ReportsALargeErrorOfOneStretchAlone) {
  FocalCheck large(mono()), small(mono());
  large.add(window_of(-0.15, 0.002));
  small.add(window_of(-0.06, 0.002));
  ASSERT_TRUE(large.note());
  EXPECT_NE(large.note()->text.find("15.0 % +- 2.2 % shorter"), std::string::npos);
  EXPECT_FALSE(small.note());
}

TEST(FocalCheck, ReportsWhatSeveralStretchesAgreeOn) {
  FocalCheck wrong(mono()), right(mono()), unsure(mono());
  for (int i = 0; i < 6; ++i) {
    wrong.add(window_of(0.1 + 0.01 * (i % 2), 0.01));
    right.add(window_of(0.004 * (i % 2), 0.001));
    unsure.add(window_of(i % 2 ? 0.2 : -0.1, 0.01));
  }
  const auto note = wrong.note();
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kCalibration);
  EXPECT_TRUE(note->doubts_scale);
  EXPECT_NE(note->text.find("longer than fx = 700 px"), std::string::npos);
  EXPECT_FALSE(right.note());
  EXPECT_FALSE(unsure.note());
}

TEST(FocalCheck, AFocalLengthThatADistortionExplainsIsNotReported) {
  FocalCheck check(mono());
  for (int i = 0; i < 6; ++i) {
    FocalEvidence evidence;
    evidence.information << 1e4, 1e4, 1e4, 1.0001e4;
    evidence.gradient = -evidence.information * Eigen::Vector2d(0, 0.03);
    check.add(evidence);
  }
  EXPECT_LT(std::abs(check.estimate().error), 3 * check.estimate().sigma);
  EXPECT_FALSE(check.note());
}

}  // namespace
}  // namespace placegraph
