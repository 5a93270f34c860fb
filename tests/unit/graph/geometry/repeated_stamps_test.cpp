#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/geometry/repeated_stamps.h>

namespace placegraph {
namespace repeated_stamps_test {

using testing::HasSubstr;
using testing::Not;

Eigen::Isometry3d at(double x, double yaw_rad = 0) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation().x() = x;
  return T;
}

/// Ten poses, 0.1 m apart.
std::vector<StampedPose> ten_poses() {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 10; ++i) poses.push_back({i, at(0.1 * i)});
  return poses;
}

TEST(RepeatedStamps, SayNothingWithoutAny) {
  EXPECT_EQ(repeated_stamps_warning("t:", ten_poses(), {}), "");
}

TEST(RepeatedStamps, NameTheFirstRowTheirNumberAndTheGreatestDistance) {
  // 0.05 m is what the body moves between two rows; the third of 0.3 m is what three rows explain.
  const std::string text = repeated_stamps_warning(
      "t.tum:", ten_poses(), {{4, 2, at(0.2)}, {9, 6, at(0.65)}, {12, 8, std::nullopt}});
  EXPECT_EQ(text,
            "t.tum:4: the stamp stands twice, and the first row of it is kept; 3 such rows are "
            "left out, up to 0.05 m and 0 deg from the kept one");
}

TEST(RepeatedStamps, SayWhereARowIsFartherThanMotionExplains) {
  const auto warning = [](const Eigen::Isometry3d& T) {
    return repeated_stamps_warning("t:", ten_poses(), {{4, 2, T}});
  };
  EXPECT_THAT(warning(at(0.2 + 0.299)), Not(HasSubstr("farther")));
  EXPECT_THAT(warning(at(0.2 + 0.301)),
              HasSubstr("; one is (the first: 4) farther than motion explains, which is 0.1 m"));
  // The body does not turn at all, so that no angle is explained.
  EXPECT_THAT(warning(at(0.2, 0.01)), HasSubstr("farther than motion explains"));
}

TEST(RepeatedStamps, AreNotJudgedByMotionWhereThereIsNone) {
  EXPECT_THAT(repeated_stamps_warning("t:", {{0, at(0)}}, {{2, 0, at(5)}}),
              Not(HasSubstr("farther")));
}

}  // namespace repeated_stamps_test
}  // namespace placegraph
