#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <sstream>

#include "tests/support/data.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace drive_test {

using synthetic::Tour;
using test::message_of;
using test::TemporaryFolder;
using ::testing::HasSubstr;

/// A straight drive of `frames` metres, climbing; the line `broken` holds `text` instead.
std::string drive(int frames, int broken = -1, const std::string& text = {}) {
  std::ostringstream out;
  for (int i = 0; i < frames; ++i) {
    if (i == broken)
      out << text << "\n";
    else
      out << "1 0 0 " << 0.01 * i << " 0 1 0 " << -0.03 * i << " 0 0 1 " << i << "\n";
  }
  return out.str();
}

SyntheticWorld open(const std::string& path) {
  SyntheticOptions options;
  options.world = path;
  return SyntheticWorld(options);
}

TEST(Drive, KeepsPositionsSeenFromAboveAndStartsAtIdentity) {
  const TemporaryFolder folder;
  const SyntheticWorld world = open(folder.write("poses.txt", drive(60)));
  ASSERT_EQ(world.size(), 60U);
  const Trajectory truth = world.ground_truth();
  EXPECT_TRUE(truth.poses[0].T_world_body->matrix().isIdentity(0));
  const Tour& tour = world.tour();
  EXPECT_NEAR(tour.T_scene_cam[40].translation()[0], 0.4, 1e-12);
  EXPECT_NEAR(tour.T_scene_cam[40].translation()[2], 40, 1e-12);
  EXPECT_EQ(world.stamp_ns(7), 700000000);  // 10 Hz without times.txt
  EXPECT_DOUBLE_EQ(*world.calibration().camera_height_m, 1.65);
}

TEST(Drive, TakesTimesAndCalibrationFromBesideThePoses) {
  const TemporaryFolder folder;
  folder.write("times.txt", "0\n0.25\n0.5\n");
  folder.write("calib.txt",
               "P0: 500 0 600 0 0 500 180 0 0 0 1 0\nP1: 500 0 600 -250 0 500 180 0 0 0 1 0\n");
  const SyntheticWorld world = open(folder.write("poses.txt", drive(3)));
  EXPECT_EQ(world.stamp_ns(2), 500000000);
  EXPECT_DOUBLE_EQ(world.calibration().camera.fx, 500);
  EXPECT_DOUBLE_EQ(world.calibration().baseline_m, 0.5);
}

TEST(Drive, BrokenPoseFilesAreNamedWithTheLine) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    const std::string path = folder.write("poses.txt", text);
    return message_of<Error>([&] { open(path); });
  };
  EXPECT_THAT(complaint(""), HasSubstr("poses.txt"));
  EXPECT_THAT(complaint(drive(1)), HasSubstr("fewer than 2 poses"));
  EXPECT_THAT(complaint(drive(9, 4, "1 0 0 0 0 1 0 0 0 0 1")), HasSubstr("poses.txt:5"));
  EXPECT_THAT(complaint(drive(9, 4, "1 0 0 0 0 1 0 x 0 0 1 4")), HasSubstr("poses.txt:5"));
  EXPECT_THAT(complaint(drive(9, 4, "nan nan nan nan nan nan nan nan nan nan nan nan")),
              HasSubstr("poses.txt:5: the pose is nan"));
  EXPECT_THAT(complaint(drive(9, 4, "1 0 0 0 0 1 0 0 0 0 1 nan")), HasSubstr("poses.txt:5"));
  EXPECT_THAT(complaint(drive(9, 4, "9 0 0 0 0 1 0 0 0 0 1 4")), HasSubstr("poses.txt:5"));
  EXPECT_THAT(complaint(drive(9, 4, "1 0 0 1e9 0 1 0 0 0 0 1 4")), HasSubstr("more than 20 m"));
  EXPECT_THAT(complaint(drive(9, 4, "1 0 0 0 0 -1 0 0 0 0 -1 4")), HasSubstr("not upright"));
}

TEST(Drive, UnknownWorldsAndBadOptionsAreRefused) {
  EXPECT_THAT(
      message_of<ArgumentError>([] { open("no-such-town"); }),
      HasSubstr(
          "neither a pose file nor one of town-loop, repeated-blocks, corridor-loop, warehouse"));
  SyntheticOptions options;
  options.frames = -1;
  EXPECT_THAT(message_of<ArgumentError>([&] { SyntheticWorld world(options); }),
              HasSubstr("frames"));
  options.frames = 0;
  options.width = 100;
  EXPECT_THAT(message_of<ArgumentError>([&] { SyntheticWorld world(options); }), HasSubstr("size"));
}

}  // namespace drive_test
}  // namespace placegraph
