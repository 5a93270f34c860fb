#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/submitted_poses.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace submitted_poses_test {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kStart = "1 0 0 0 0 1 0 0 0 0 1 0\n";

class SubmittedPosesTest : public testing::Test {
 protected:
  SubmittedPoses read(const std::string& text) {
    return read_submitted_poses(folder.write("00.txt", text));
  }
  /// One fault, in this line and of this text; lines with text are counted all the same.
  void expect_fault(const std::string& text, int line, const std::string& message) {
    SCOPED_TRACE(text);
    const SubmittedPoses submitted = read(text);
    ASSERT_EQ(submitted.faults.size(), 1u);
    EXPECT_EQ(submitted.faults[0].line, line);
    EXPECT_THAT(submitted.faults[0].text, HasSubstr(message));
  }
  test::TemporaryFolder folder;
};

TEST_F(SubmittedPosesTest, WhatIsWrittenAsKittiIsReadWithoutAFault) {
  const Trajectory drive = test::winding_drive(300, 1, false);
  write_trajectory(folder / "05.txt", drive, TrajectoryFormat::kKitti);
  const SubmittedPoses submitted = read_submitted_poses(folder / "05.txt");
  EXPECT_THAT(submitted.faults, IsEmpty());
  const Trajectory same = read_trajectory(folder / "05.txt");
  ASSERT_EQ(submitted.poses.size(), same.size());
  for (std::size_t i = 0; i < same.size(); ++i)
    EXPECT_EQ(submitted.poses.poses[i].T_world_body->matrix(),
              same.poses[i].T_world_body->matrix());
  EXPECT_FALSE(submitted.poses.has_times);
}

TEST_F(SubmittedPosesTest, EveryFormOfNumberThatTheDevkitReadsIsRead) {
  const SubmittedPoses submitted =
      read("+1.0e+00\t0 0 -1.5E1 0 1 0 0 0 0 1.000 0  \r\n\n" + std::string(kStart));
  EXPECT_THAT(submitted.faults, IsEmpty());
  ASSERT_EQ(submitted.poses.size(), 2u);
  EXPECT_EQ(submitted.poses.poses[0].T_world_body->translation().x(), -15);
}

TEST_F(SubmittedPosesTest, AFaultIsNamedWithItsLine) {
  const std::string start = kStart;
  expect_fault(start + "1 0 0 0 0 1 0 0 0 0 1\n", 2, "11 numbers, not 12");
  expect_fault("0.1 1 2 3 0 0 0 1\n" + start, 1, "8 numbers, not 12 (a time and a quaternion");
  expect_fault("0 1 0 0 0 0 1 0 0 0 0 1 0\n", 1, "13 numbers, not 12 (a time or a number");
  expect_fault("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n", 1, "16 numbers, not 12 (a whole 4x4");
  expect_fault(start + start + "1 0 0 0 0 1 0 0 0 0 1 O\n", 3, "'O' is not a number");
  expect_fault("1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0\n", 1, "'1,' is not a number");
  expect_fault(start + "1 0 0 inf 0 1 0 0 0 0 1 0\n", 2, "1 of 12 numbers are not finite");
  expect_fault(start + "nan nan nan nan nan nan nan nan nan nan nan nan\n", 2, "a lost frame");
  expect_fault("1 0 0 0 0 1 0 0 0 0 -1 0\n", 1, "is a reflection");
  expect_fault("2 0 0 0 0 1 0 0 0 0 1 0\n", 1, "is not a rotation");
  expect_fault("0 0 0 0 0 0 0 0 0 0 0 0\n", 1, "is not a rotation");
  expect_fault("\xEF\xBB\xBF" + start, 1, "byte order mark");
  expect_fault("", 0, "holds no pose");
  expect_fault("# poses of a drive\n" + start, 1, "5 numbers, not 12");
}

TEST_F(SubmittedPosesTest, AKindOfFaultHasOneLineAndTheNumberOfTheOthers) {
  std::string text = kStart;
  for (int i = 0; i < 5; ++i) text += "1 0 0 0 0 1 0 0 0 0 1\n";
  text += "1 0 0 0 0 1 0 0 0 0 x 0\n";
  const SubmittedPoses submitted = read(text);
  ASSERT_EQ(submitted.faults.size(), 2u);
  EXPECT_EQ(submitted.faults[0].line, 2);
  EXPECT_THAT(submitted.faults[0].text,
              HasSubstr("11 numbers, not 12 (likewise on 5 lines in all)"));
  EXPECT_EQ(submitted.faults[1].line, 7);
  EXPECT_EQ(submitted.poses.size(), 7u);
  EXPECT_EQ(submitted.poses.posed(), 1u);
}

// Digits behind the point: four make a rotation, three do not.
TEST_F(SubmittedPosesTest, RoundedRotationsAreRotationsToFourDigits) {
  EXPECT_THAT(read("0.7071 0 0.7071 0 0 1 0 0 -0.7071 0 0.7071 0\n").faults, IsEmpty());
  EXPECT_EQ(read("0.706 0 0.708 0 0 1 0 0 -0.707 0 0.707 0\n").faults.size(), 1u);
}

TEST_F(SubmittedPosesTest, AFileThatIsNoTextIsRefused) {
  EXPECT_THAT(test::message_of<FileError>([&] { read_submitted_poses(folder / "01.txt"); }),
              HasSubstr("01.txt"));
  EXPECT_THROW(read_submitted_poses(folder.path()), FileError);
}

}  // namespace submitted_poses_test
}  // namespace placegraph
