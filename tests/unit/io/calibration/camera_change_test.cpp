#include <gtest/gtest.h>
#include <placegraph/io/calibration/camera_change.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace camera_change_test {

Camera camera(int width, int height, double focal) {
  return {.width = width,
          .height = height,
          .fx = focal,
          .fy = focal,
          .cx = 0.5 * (width - 1),
          .cy = 0.5 * (height - 1)};
}

/// Grey by the direction that a pixel looks in.
Image slope(const Camera& of) {
  Image image(of.height, of.width, CV_8UC1);
  for (int v = 0; v < of.height; ++v)
    for (int u = 0; u < of.width; ++u)
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          128 + 150 * (u - of.cx) / of.fx + 60 * (v - of.cy) / of.fy);
  return image;
}

TEST(CameraChange, LeavesTheSameCamerasFramesAlone) {
  const CameraChange change(camera(64, 48, 50), camera(64, 48, 50));
  EXPECT_TRUE(change.is_identity());
  EXPECT_EQ(change.seen_share(), 1);
  Frame frame;
  frame.image = slope(camera(64, 48, 50));
  frame.depth = Image(48, 64, CV_32FC1, cv::Scalar(2));
  const Image before = frame.image;
  change.apply(frame);
  EXPECT_EQ(frame.image.data, before.data);
  EXPECT_FALSE(frame.depth.empty());
  EXPECT_TRUE(frame.mask.empty());
}

TEST(CameraChange, LooksInTheSameDirections) {
  // Twice the size, four fifths of it, and a longer lens.
  const Camera to = camera(160, 120, 100);
  for (const Camera& from : {camera(320, 240, 200), camera(128, 96, 80), camera(160, 120, 125)}) {
    const CameraChange change(from, to);
    Frame frame;
    frame.image = slope(from);
    frame.right = frame.image;
    frame.depth = Image(10, 10, CV_32FC1, cv::Scalar(2));
    change.apply(frame);
    ASSERT_EQ(frame.image.size(), cv::Size(160, 120));
    EXPECT_TRUE(frame.right.empty());
    EXPECT_TRUE(frame.depth.empty());
    const Image expected = slope(to);
    EXPECT_GT(cv::countNonZero(frame.mask), 0);
    EXPECT_LE(cv::norm(frame.image, expected, cv::NORM_INF, frame.mask), 2) << from.width;
  }
}

TEST(CameraChange, MasksWhatIsNotSeen) {
  const CameraChange change(camera(160, 120, 125), camera(160, 120, 100));
  EXPECT_NEAR(change.seen_share(), 0.64, 0.02);
  Frame frame;
  frame.image = slope(camera(160, 120, 125));
  frame.mask = Image(120, 160, CV_8UC1, cv::Scalar(255));
  frame.mask.colRange(0, 80) = 0;
  change.apply(frame);
  EXPECT_EQ(frame.mask.at<std::uint8_t>(60, 5), 0);   // beyond the left border
  EXPECT_EQ(frame.mask.at<std::uint8_t>(60, 60), 0);  // masked by the frame
  EXPECT_NE(frame.mask.at<std::uint8_t>(60, 100), 0);
  EXPECT_EQ(frame.mask.at<std::uint8_t>(60, 140), 0);  // its surroundings are not seen
}

}  // namespace camera_change_test
}  // namespace placegraph
