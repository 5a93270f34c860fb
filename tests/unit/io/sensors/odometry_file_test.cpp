#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/sensors/odometry_file.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace odometry_file_test {

using namespace test;

class OdometryFile : public testing::Test {
 protected:
  MeasuredMotion read(const std::string& text) {
    folder.write("odometry.txt", text);
    return read_odometry(path(), {}, {0, 100'000'000});
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const FileError& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
  std::string path() const { return folder / "odometry.txt"; }
  TemporaryFolder folder;
};

const SE3 kStep = pose({0, 0, 0}, {0, 0, 2});

TEST_F(OdometryFile, ReadsStampedPoses) {
  const MeasuredMotion motion = read("# t x y z q\n1 0 0 0 0 0 0 1\n1.5 0 0 2 0 0 0 1\n");
  ASSERT_EQ(motion.steps().size(), 1u);
  EXPECT_EQ(motion.steps()[0].from_ns, 1'000'000'000);
  EXPECT_EQ(motion.steps()[0].to_ns, 1'500'000'000);
  EXPECT_LT(distance_m(motion.steps()[0].T_from_to, kStep), 1e-12);
  EXPECT_LT((motion.steps()[0].covariance - MotionNoise().covariance(kStep)).norm(), 1e-15);
}

TEST_F(OdometryFile, ReadsStepsWithDeviationsAndPosesWithCovariances) {
  const MeasuredMotion steps =
      read("0 1 0 0 2 0 0 0 1 .1 .2 .3 .01 .02 .03\n2 3 0 0 2 0 0 0 1 .1 .2 .3 .01 .02 .03\n");
  ASSERT_EQ(steps.steps().size(), 2u);
  EXPECT_NEAR(steps.steps()[1].covariance(2, 2), 0.09, 1e-15);
  EXPECT_FALSE(steps.between(500'000'000, 2'500'000'000));  // a gap
  std::string upper;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) upper += i == j ? " 4" : i == 0 && j == 5 ? " 0.5" : " 0";
  const MeasuredMotion poses = read("0 0 0 0 0 0 0 1" + upper + "\n1 0 0 2 0 0 0 1" + upper + "\n");
  EXPECT_EQ(poses.steps()[0].covariance(0, 5), 0.5);
  EXPECT_EQ(poses.steps()[0].covariance(5, 0), 0.5);
  EXPECT_EQ(poses.steps()[0].covariance(3, 3), 4);
}

TEST_F(OdometryFile, ReadsPosesOfFrames) {
  const std::string first = "1 0 0 0 0 1 0 0 0 0 1 0\n", second = "1 0 0 0 0 1 0 0 0 0 1 2\n";
  const MeasuredMotion motion = read(first + second);
  EXPECT_EQ(motion.steps()[0].to_ns, 100'000'000);
  EXPECT_LT(distance_m(motion.steps()[0].T_from_to, kStep), 1e-12);
  EXPECT_THAT(refusal(first), testing::HasSubstr("1 poses without times, but the sequence has 2"));
}

TEST_F(OdometryFile, RefusesWhatIsNone) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("1 2 3\n"), HasSubstr("odometry.txt:1: has positions alone"));
  EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1 5\n"),
              HasSubstr("odometry.txt:2: 8 fields needed as in the first line, not 9"));
  EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
              HasSubstr("odometry.txt: there is no step of motion"));
  EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n0.9 0 0 0 0 0 0 1\n"),
              HasSubstr("odometry.txt:2: times must increase"));
  EXPECT_THAT(refusal("1 2 0 0 0 0 0 0 1\n1.5 3 0 0 0 0 0 0 1\n"),
              HasSubstr("odometry.txt:2: times must increase"));
  EXPECT_THAT(refusal("2 1 0 0 0 0 0 0 1\n"), HasSubstr("odometry.txt:1: times must increase"));
  EXPECT_THAT(refusal("1 0 0 0 0 0 0 2\n"), HasSubstr("odometry.txt:1: quaternion"));
  EXPECT_THAT(refusal("1 0 nan 0 0 0 0 1\n"), HasSubstr("odometry.txt:1: pose"));
  EXPECT_THAT(refusal("1 2 0 0 0 0 0 0 1 1 1 1 1 1 0\n"),
              HasSubstr("odometry.txt:1: standard deviation must be positive"));
  std::string zeros;
  for (int i = 0; i < 21; ++i) zeros += " 0";
  EXPECT_THAT(refusal("1 2 0 0 0 0 0 0 1" + zeros + "\n"),
              HasSubstr("odometry.txt:1: covariance is not positive definite"));
  EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n"), HasSubstr("no step of motion"));
  EXPECT_THROW(read_odometry(path() + ".none", {}, {}), FileError);
}

}  // namespace odometry_file_test
}  // namespace placegraph
