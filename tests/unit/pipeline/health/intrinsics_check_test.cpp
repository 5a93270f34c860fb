#include <gtest/gtest.h>
#include <placegraph/pipeline/health/intrinsics_check.h>

#include <cmath>

namespace placegraph {
namespace intrinsics_check_test {

using Evidence = IntrinsicsEvidence;

Calibration mono() {
  Calibration calibration;
  calibration.camera.fx = calibration.camera.fy = 700;
  return calibration;
}

/// Of a window that measures one parameter to `sigma`, and nothing of the others.
Evidence window_of(Evidence::Parameter parameter, double error, double sigma) {
  Evidence evidence;
  evidence.information(parameter, parameter) = 1 / (sigma * sigma);
  evidence.gradient[parameter] = -error / (sigma * sigma);
  return evidence;
}

TEST(IntrinsicsCheck, IsTheWeightedMeanOfItsWindows) {
  IntrinsicsCheck check(mono());
  EXPECT_TRUE(std::isinf(check.estimate().sigmas[0]));
  check.add(window_of(Evidence::kFocal, 0.10, 0.001));
  EXPECT_NEAR(check.estimate().errors[0], 0.10, 3e-3);
  EXPECT_NEAR(check.estimate().sigmas[0], std::hypot(0.02, 0.015), 1e-3);  // a window's own error
  check.add(window_of(Evidence::kFocal, 0.13, 1));
  EXPECT_NEAR(check.estimate().errors[0], 0.10, 3e-3);
  for (int i = 0; i < 24; ++i) check.add(window_of(Evidence::kFocal, 0.10, 0.001));
  EXPECT_NEAR(check.estimate().sigmas[0], std::hypot(0.004, 0.015), 1e-3);
}

TEST(IntrinsicsCheck, ReportsALargeErrorOfOneStretchAlone) {
  IntrinsicsCheck large(mono()), small(mono());
  large.add(window_of(Evidence::kFocal, -0.15, 0.002));
  small.add(window_of(Evidence::kFocal, -0.06, 0.002));
  ASSERT_EQ(large.notes().size(), 1u);
  EXPECT_NE(large.notes()[0].text.find("a focal length that is 15 % +- 2 % shorter"),
            std::string::npos)
      << large.notes()[0].text;
  EXPECT_TRUE(small.notes().empty());
}

TEST(IntrinsicsCheck, ReportsWhatSeveralStretchesAgreeOn) {
  IntrinsicsCheck wrong(mono()), right(mono()), unsure(mono());
  for (int i = 0; i < 6; ++i) {
    wrong.add(window_of(Evidence::kPrincipalY, -0.06 + 0.01 * (i % 2), 0.01));
    right.add(window_of(Evidence::kFocal, 0.004 * (i % 2), 0.001));
    unsure.add(window_of(Evidence::kFocal, i % 2 ? 0.2 : -0.1, 0.01));
  }
  ASSERT_EQ(wrong.notes().size(), 1u);
  const DataNote note = wrong.notes()[0];
  EXPECT_EQ(note.cause, NoteCause::kCalibration);
  EXPECT_TRUE(note.doubts_scale);
  EXPECT_NE(note.text.find("px above the stated one"), std::string::npos) << note.text;
  EXPECT_TRUE(right.notes().empty());
  ASSERT_EQ(unsure.notes().size(), 1u);  // the stretches contradict each other
  EXPECT_EQ(unsure.notes()[0].cause, NoteCause::kDrift);
}

TEST(IntrinsicsCheck, AFocalLengthThatADistortionExplainsIsNotReported) {
  IntrinsicsCheck check(mono());
  for (int i = 0; i < 6; ++i) {
    Evidence evidence;
    for (const Eigen::Index a : {Evidence::kFocal, Evidence::kRadial})
      for (const Eigen::Index b : {Evidence::kFocal, Evidence::kRadial})
        evidence.information(a, b) = 1e4;
    evidence.information(Evidence::kRadial, Evidence::kRadial) += 1;
    evidence.gradient = -0.03 * evidence.information.col(Evidence::kRadial);
    check.add(evidence);
  }
  EXPECT_TRUE(check.notes().empty());
}

}  // namespace intrinsics_check_test
}  // namespace placegraph
