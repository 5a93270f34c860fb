#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/health/flow_check.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace flow_check_test {

Camera camera() {
  Camera camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300;
  camera.cx = 160;
  camera.cy = 120;
  return camera;
}

Calibration mono() {
  Calibration calibration;
  calibration.camera = camera();
  return calibration;
}

TEST(DistanceToHalfLine, IsZeroAtEveryDepth) {
  const SE3 T_ref_cur(SO3::exp({0.01, -0.02, 0.03}), Eigen::Vector3d(0.2, 0.05, 0.1));
  for (const double depth : {0.7, 2.0, 1e6}) {
    const Eigen::Vector3d p_ref(0.1 * depth, -0.2 * depth, depth);
    const auto px_ref = camera().project(p_ref),
               px_cur = camera().project(T_ref_cur.inverse() * p_ref);
    ASSERT_TRUE(px_ref && px_cur);
    EXPECT_NEAR(distance_to_half_line(camera(), T_ref_cur, {*px_ref, *px_cur}).value(), 0, 1e-6);
  }
}

TEST(DistanceToHalfLine, PointsDoNotMoveTowardsWhereTheyComeFrom) {
  const SE3 forwards(SO3(), Eigen::Vector3d(0, 0, 1));
  const Eigen::Vector2d px(200, 120);
  EXPECT_NEAR(distance_to_half_line(camera(), forwards, {px, {230, 120}}).value(), 0, 1e-9);
  EXPECT_NEAR(distance_to_half_line(camera(), forwards, {px, {190, 120}}).value(), 10, 1e-9);
  EXPECT_NEAR(distance_to_half_line(camera(), forwards, {px, {200, 125}}).value(), 5, 1e-9);
}

TEST(DistanceToHalfLine, EndsAtTheEpipole) {
  const SE3 backwards(SO3(), Eigen::Vector3d(0, 0, -1));
  EXPECT_NEAR(distance_to_half_line(camera(), backwards, {{200, 120}, {150, 120}}).value(), 10,
              1e-9);
}

TEST(DistanceToHalfLine, OfARotationIsThatToOnePixel) {
  EXPECT_NEAR(distance_to_half_line(camera(), SE3(), {{200, 120}, {203, 124}}).value(), 5, 1e-9);
}

/// Frames of a texture that moves by `step_px` an image; an object covers the left part of it
/// without moving.
std::vector<Frame> frames(int count, double step_px, int covered_px) {
  cv::RNG random(5);
  Image texture(240, 640, CV_8UC1), object(240, 640, CV_8UC1);
  for (Image* image : {&texture, &object}) {
    random.fill(*image, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(*image, *image, {}, 2);
    cv::normalize(*image, *image, 0, 255, cv::NORM_MINMAX);
  }
  std::vector<Frame> result;
  for (int i = 0; i < count; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    const cv::Matx23f shift(1, 0, static_cast<float>(-step_px * i), 0, 1, 0);
    cv::warpAffine(texture, frame.image, shift, {320, 240}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    if (covered_px > 0)
      object(cv::Rect(0, 0, covered_px, 240)).copyTo(frame.image(cv::Rect(0, 0, covered_px, 240)));
    result.push_back(frame);
  }
  return result;
}

std::optional<DataNote> note_of(double step_px, int covered_px, double estimated_step_px) {
  FlowCheck check(mono());
  const std::vector<Frame> all = frames(20, step_px, covered_px);
  for (std::size_t i = 0; i < all.size(); ++i)
    check.add(all[i], SE3(SO3::exp({0, estimated_step_px * static_cast<double>(i) / 300, 0}),
                          Eigen::Vector3d::Zero()));
  return check.note();
}

TEST(FlowCheck, AgreesWithTheMotionOfTheImages) { EXPECT_FALSE(note_of(3, 0, 3)); }

TEST(FlowCheck, SmallObjectsMayMoveOtherwise) { EXPECT_FALSE(note_of(3, 80, 3)); }

TEST(FlowCheck, ReportsAnObjectThatHasTakenTheMotionAlong) {
  const auto note = note_of(3, 120, 0);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kDrift);
  EXPECT_NE(note->text.find("between the frames 3 and 19"), std::string::npos) << note->text;
}

TEST(FlowCheck, OneComparisonAloneIsNotReported) {
  FlowCheck check(mono());
  for (const double share : {0.0, 0.7, 0.1, 0.6, 0.0}) check.add(FrameId(1), share);
  EXPECT_FALSE(check.note());
  check.add(FrameId(20), 0.5);
  EXPECT_FALSE(check.note());
  check.add(FrameId(24), 0.5);
  EXPECT_TRUE(check.note());
}

}  // namespace flow_check_test
}  // namespace placegraph
