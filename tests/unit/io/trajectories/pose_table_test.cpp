#include <placegraph/io/trajectories/pose_table.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace pose_table_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

/// Turned by 90 degrees about z, at (1, 2, 3).
constexpr const char* kMatrix = "0 -1 0 1 1 0 0 2 0 0 1 3";
constexpr const char* kScalarLast = "1 2 3 0 0 0.70710678 0.70710678";
constexpr const char* kScalarFirst = "1 2 3 0.70710678 0 0 0.70710678";

class PoseTableOf : public testing::Test {
 protected:
  /// The last pose of a table.
  PoseLine last(const std::string& text) {
    PoseTable table(folder_.write("p", text));
    columns_ = table.columns();
    PoseLine line;
    while (table.next(line)) continue;
    return line;
  }
  void expect_pose(const std::string& text) {
    const PoseLine line = last(text);
    ASSERT_TRUE(line.T_world_body) << text;
    EXPECT_TRUE(line.oriented) << text;
    Eigen::Matrix4d expected;
    expected << 0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1;
    EXPECT_LT((line.T_world_body->matrix() - expected).norm(), 1e-7) << text;
  }
  std::string refusal(const std::string& text) {
    const std::string path = folder_.write("p", text);
    return message_of([&] { PoseTable table(path); });
  }

  const TemporaryFolder folder_;
  PoseColumns columns_;
};

std::string with(std::string line, char separator) {
  std::replace(line.begin(), line.end(), ' ', separator);
  return line + "\n";
}

TEST_F(PoseTableOf, MatricesMayHaveAFourthRowAndNumbers) {
  const std::string row = std::string(kMatrix) + " 0 0 0 1";
  for (const char separator : {' ', '\t', ',', ';'}) {
    expect_pose(with(kMatrix, separator));
    EXPECT_FALSE(columns_.stamp);
    expect_pose(with(row, separator));
    expect_pose(with("7 " + std::string(kMatrix), separator));
    EXPECT_EQ(columns_.unit, StampUnit::kFrameNumber);
    EXPECT_EQ(last(with("7 " + row, separator)).stamp, 7);
  }
  expect_pose(with("1600000000.5 " + row, ' '));
  EXPECT_EQ(columns_.unit, StampUnit::kSeconds);
  EXPECT_THAT(message_of([&] { last(std::string(kMatrix) + " 0 0 0 2\n"); }),
              HasSubstr("p:1: the last row"));
}

TEST_F(PoseTableOf, SecondsHaveTumsColumnsAndNanosecondsEurocsBetweenCommas) {
  for (const char separator : {' ', '\t', ',', ';'})
    expect_pose(with("1600000000.25 " + std::string(kScalarLast), separator));
  EXPECT_EQ(columns_.unit, StampUnit::kSeconds);
  for (const char* ns :
       {"1600000000250000000", "1600000000250000000.0", "1.60000000025e+18", "250"})
    for (const char separator : {',', ';'}) {
      expect_pose(with(std::string(ns) + " " + kScalarFirst, separator));
      EXPECT_EQ(columns_.unit, StampUnit::kNanoseconds) << ns;
    }
  EXPECT_EQ(last(with("1.600000000250000000e+18 " + std::string(kScalarFirst), ',')).stamp,
            1600000000250000000);
  // Further columns are EuRoC's speeds and biases; as many as a matrix has are still none.
  expect_pose(with("1600000000250000000 " + std::string(kScalarFirst) + " 9 9 9 8 8 8 7 7 7", ','));
  // Nanoseconds between blanks keep TUM's order.
  expect_pose(with("1600000000250000000 " + std::string(kScalarLast), ' '));
}

TEST_F(PoseTableOf, AnIdIsPassedOverOnEitherSide) {
  expect_pose("0.5 " + std::string(kScalarLast) + " 17\n");
  expect_pose("17 0.5 " + std::string(kScalarLast) + "\n");
  const std::string message = refusal("1 2 3 4 5 6 7 8 9\n");
  EXPECT_THAT(message, HasSubstr("p:1: is no trajectory: 9 fields between blanks"));
  EXPECT_THAT(message, HasSubstr("as t x y z qx qy qz qw -: line 1: the quaternion has length"));
  EXPECT_THAT(message, HasSubstr("as - t x y z qx qy qz qw: line 1: the quaternion has length"));
}

TEST_F(PoseTableOf, WholeSecondsAndNanosecondsAreOneTime) {
  for (const char separator : {' ', ',', ';'}) {
    expect_pose(with("1600000000 250000000 " + std::string(kScalarLast), separator));
    EXPECT_EQ(last(with("1600000000 250000000 " + std::string(kScalarLast), separator)).stamp,
              1600000000250000000);
    EXPECT_EQ(last(with("1600000000 5 1 2 3", separator)).stamp, 1600000000000000005);
  }
  const std::string pose = " " + std::string(kScalarLast) + "\n";
  EXPECT_EQ(last("3 900000000" + pose + "3 950000000" + pose + "4 0" + pose).stamp, 4'000'000'000);
  // A whole second and a whole coordinate, with an id behind the quaternion.
  expect_pose("1600000000 " + std::string(kScalarLast) + " 17\n");
  // Numbers of lines, or of objects, before whole times.
  EXPECT_EQ(last("3 90" + pose + "4 95" + pose).stamp, 95'000'000'000);
  EXPECT_EQ(last("7 90" + pose + "7 95" + pose).stamp, 95'000'000'000);
  // A second is no nanoseconds.
  EXPECT_EQ(last("3 1000000000" + pose + "3 1100000000" + pose).stamp,
            1'100'000'000'000'000'000);
}

TEST_F(PoseTableOf, PositionsMayStandAlone) {
  EXPECT_FALSE(last("0.5 1 2 3\n").oriented);
  EXPECT_EQ(last("0.5 1 2 3\n").T_world_body->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(last("0.5,1,2,3\n").stamp, 500'000'000);
  EXPECT_EQ(last("1 2 3\n").T_world_body->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(last("nan nan nan\n").T_world_body);
}

TEST_F(PoseTableOf, MarksCommentsAndLineEndsAreNoPartOfTheNumbers) {
  expect_pose("\xEF\xBB\xBF" + std::string(kMatrix) + "\r\n");
  expect_pose("\xEF\xBB\xBF# t x y z qx qy qz qw\r\n0 " + std::string(kScalarLast) + "\r\n");
  expect_pose("% made elsewhere\n" + std::string(kMatrix) + " # the last one\n\n");
  EXPECT_THAT(refusal("\xFF\xFE"
                      "1"),
              HasSubstr("p: is text in UTF-16"));
}

TEST_F(PoseTableOf, AHeaderIsObeyed) {
  expect_pose("#timestamp [ns],px,py,pz,qx,qy,qz,qw\n" +
              with("1600000000250000000 " + std::string(kScalarLast), ','));
  EXPECT_EQ(columns_.unit, StampUnit::kNanoseconds);
  expect_pose("# t x y z qw qx qy qz\n0.5 " + std::string(kScalarFirst) + "\n");
  expect_pose("timestamp_ms;qw;qx;qy;qz;tx;ty;tz\n250;0.70710678;0;0;0.70710678;1;2;3\n");
  EXPECT_EQ(last("t_us,x,y,z\n5,1,2,3\n").stamp, 5000);
  EXPECT_EQ(last("x,y,z,t\n1,2,3,0.5\n").stamp, 500'000'000);
  // Commas in the header alone.
  expect_pose("# t, x, y, z, qw, qx, qy, qz\n0.5 " + std::string(kScalarFirst) + "\n");
}

TEST_F(PoseTableOf, AHeaderThatCannotBeObeyedIsRefused) {
  EXPECT_THAT(refusal("#t,x,y,z,roll,pitch,yaw\n0,1,2,3,0,0,0\n"),
              HasSubstr("p:1: the header names an angle, 'roll'"));
  EXPECT_THAT(refusal("# t x y z qw qx qy qz id\n0 1 2 3 1 0 0 0\n"),
              HasSubstr("p:1: the header names 9 columns, but the lines have 8"));
  EXPECT_THAT(refusal("t,x,y,z,qx,qy,qz\n0,1,2,3,0,0,0\n"),
              HasSubstr("p:1: the header names 3 of the four parts"));
  EXPECT_THAT(refusal("a,b,c\n1,2,3\n"), HasSubstr("p:1: is no trajectory: 'a,b,c'"));
}

TEST_F(PoseTableOf, RemarksAreNoHeaders) {
  expect_pose("# x y z are metres\n0.5 " + std::string(kScalarLast) + "\n");
  expect_pose("# ground truth trajectory\n# file: 'a.bag'\n0.5 " + std::string(kScalarLast) + "\n");
}

TEST_F(PoseTableOf, UnknownNumbersOfFieldsAreCounted) {
  EXPECT_THAT(refusal("1 2 3 4 5\n"), HasSubstr("p:1: is no trajectory: 5 fields between blanks"));
  EXPECT_THAT(refusal("1,2\n"), HasSubstr("2 fields between commas, '1,2'; readable are"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("p: holds no poses"));
  EXPECT_THAT(refusal("t,x,y,z\n"), HasSubstr("p: holds no poses"));
}

}  // namespace pose_table_test
}  // namespace placegraph
