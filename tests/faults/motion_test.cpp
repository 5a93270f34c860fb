#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace motion_test {

TEST(FaultMotion, OrdersFollowThePath) {
  const Recording recording = small_recording();
  const auto source = [&](const char* name, std::size_t i) {
    return source_of(recording, faulty(recording, name), i);
  };
  EXPECT_EQ(faulty(recording, "teleport").size(), 40U);
  EXPECT_EQ(source("teleport", 19), 19);
  EXPECT_EQ(source("teleport", 20), 40);
  EXPECT_EQ(source("backwards", 0), 59);
  EXPECT_EQ(source("there_and_back", 30), 30);
  EXPECT_EQ(source("there_and_back", 31), 29);
  EXPECT_EQ(faulty(recording, "there_and_back").size(), 61U);
}

TEST(FaultMotion, TruthGoesWithTheImages) {
  const Recording recording = small_recording(), out = faulty(recording, "backwards");
  EXPECT_TRUE(out.T_world_cam[10].isApprox(recording.T_world_cam[49]));
  EXPECT_EQ(out.frames[10].stamp_ns, recording.frames[10].stamp_ns);
}

/// The pixel of a point of the world in the left camera of a frame.
Eigen::Vector2d pixel(const Recording& recording, std::size_t i, const Eigen::Vector3d& p_world) {
  return recording.calibration.camera.project(recording.T_world_cam[i].inverse() * p_world).value();
}

TEST(FaultMotion, KidnappedCameraSeesTheMirroredWorldElsewhere) {
  Recording recording = small_recording();
  const Recording out = faulty(recording, "kidnap");
  EXPECT_TRUE(equal(out.frames[29].image, recording.frames[29].image));
  EXPECT_GT((out.T_world_cam[30].translation() - recording.T_world_cam[29].translation()).norm(),
            900);
  // The left image shows the mirrored right one: a point at pixel u there is at 2 cx - u here.
  const Image& right = recording.frames[40].right;
  const Image& left = out.frames[40].image;
  EXPECT_EQ(left.at<uchar>(20, 50), right.at<uchar>(20, 2 * 46 - 50));
  // So is its projection by the truth.
  const Eigen::Vector3d p_world = recording.T_world_cam[40] * Eigen::Vector3d(0.3, 0.1, 4);
  const Eigen::Vector3d mirrored(-p_world.x() + 1000, p_world.y(), p_world.z());
  Recording of_right = recording;
  of_right.T_world_cam[40].translate(Eigen::Vector3d(0.2, 0, 0));
  EXPECT_NEAR(pixel(out, 40, mirrored)[0], 2 * 46 - pixel(of_right, 40, p_world)[0], 1e-9);
  EXPECT_NEAR(pixel(out, 40, mirrored)[1], pixel(of_right, 40, p_world)[1], 1e-9);
}

TEST(FaultMotion, StandingCameraHasOneTruthAndNoiseOfItsOwnInEachImage) {
  const Recording recording = small_recording();
  const Recording all = faulty(recording, "standing");
  EXPECT_TRUE(all.T_world_cam[50].isApprox(recording.T_world_cam[0]));
  EXPECT_FALSE(equal(all.frames[49].image, all.frames[50].image));
  EXPECT_LT(cv::norm(all.frames[50].image, recording.frames[0].image, cv::NORM_INF), 12);
  const Recording part = faulty(recording, "standing_while");
  ASSERT_EQ(part.size(), 100U);
  EXPECT_TRUE(part.T_world_cam[69].isApprox(recording.T_world_cam[30]));
  EXPECT_TRUE(part.T_world_cam[99].isApprox(recording.T_world_cam[59]));
}

/// Where the bright spot of an image is.
Eigen::Vector2d spot(const Image& image) {
  const cv::Moments m = cv::moments(image);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

/// A recording of a far point at a pixel of the first image.
Recording with_spot(const cv::Point& at) {
  Recording recording = small_recording();
  for (Frame& frame : recording.frames) {
    frame.right = frame.depth = Image();
    frame.image = Image::zeros(64, 96, CV_8UC1);
    cv::circle(frame.image, at, 3, cv::Scalar(255), cv::FILLED);
    cv::GaussianBlur(frame.image, frame.image, {}, 1.0);
  }
  recording.calibration.depth.reset();
  return recording;
}

TEST(FaultMotion, RotatedCameraSeesAPointWhereItsTruthSays) {
  const Recording recording = with_spot({50, 36});
  const Eigen::Vector3d ray = recording.calibration.camera.unproject({50, 36}).value();
  const Recording rotation = faulty(recording, "rotation_on_the_spot");
  const Eigen::Vector3d far = recording.T_world_cam[0] * Eigen::Vector3d(1e6 * ray);
  EXPECT_LT((spot(rotation.frames[5].image) - pixel(rotation, 5, far)).norm(), 0.3);
  EXPECT_GT((spot(rotation.frames[0].image) - spot(rotation.frames[5].image)).norm(), 5);
  const Recording shaken = faulty(recording, "shaken");
  const Eigen::Vector3d far_7 = recording.T_world_cam[7] * Eigen::Vector3d(1e6 * ray);
  EXPECT_LT((spot(shaken.frames[7].image) - pixel(shaken, 7, far_7)).norm(), 0.1);
  const Recording down = faulty(recording, "upside_down");
  EXPECT_LT((spot(down.frames[7].image) - pixel(down, 7, far_7)).norm(), 0.1);
}

TEST(FaultMotion, UpsideDownRigHasItsRightCameraLeft) {
  const Recording recording = small_recording(), out = faulty(recording, "upside_down");
  Image back;
  cv::flip(out.frames[3].image, back, -1);
  EXPECT_TRUE(equal(back, recording.frames[3].right));
  // Its right camera is the former left one.
  const Eigen::Vector3d right = out.T_world_cam[3] * Eigen::Vector3d(0.2, 0, 0);
  EXPECT_LT((right - recording.T_world_cam[3].translation()).norm(), 1e-9);
}

}  // namespace motion_test
}  // namespace placegraph::faults::test
