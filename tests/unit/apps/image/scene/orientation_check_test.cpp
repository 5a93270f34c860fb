#include "apps/image/scene/orientation_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <numbers>

#include "apps/image/scene/plane_truth.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace orientation_check_test {

TEST(PlaneTruth, RefusesWhatIsNoPlane) {
  test::TemporaryFolder dir;
  dir.write("good.txt", "0 0 0 0\n0 1 0 1.4\n");
  EXPECT_EQ(read_planes(dir / "good.txt").size(), 2U);
  dir.write("short.txt", "0 0 0 0\n0 1 0\n");
  EXPECT_THROW((void)read_planes(dir / "short.txt"), FileError);
  dir.write("long.txt", "0 0 0 0\n0 2 0 1\n");
  EXPECT_THROW((void)read_planes(dir / "long.txt"), FileError);
  dir.write("empty.txt", "");
  EXPECT_THROW((void)read_planes(dir / "empty.txt"), FileError);
}

TEST(OrientationCheck, CountsPixelsThatAreRight) {
  Image labels(1, 4, CV_8UC1, cv::Scalar(0)), planes(1, 4, CV_16UC1, cv::Scalar(1));
  labels.at<std::uint8_t>(0, 0) = 2, labels.at<std::uint8_t>(0, 1) = 1;
  labels.at<std::uint8_t>(0, 2) = 2, planes.at<std::uint16_t>(0, 2) = 0;
  OrientationCheck check;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  check_orientation(labels, I, planes, {{0, 0, 0}, {0, -1, 0}}, I, check);
  EXPECT_EQ(check.judged, 3U);
  EXPECT_EQ(check.oriented, 2U);
  EXPECT_EQ(check.right, 1U);
}

}  // namespace orientation_check_test
}  // namespace placegraph::apps
