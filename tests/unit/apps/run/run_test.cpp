#include "apps/run/run.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/message_of.h"
#include "tests/support/scenes/street_files.h"

namespace placegraph::apps {
namespace run_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;
namespace fs = std::filesystem;

class RunCommandFunction : public testing::Test {
 protected:
  RunCommandFunction() {
    arguments.sequence = folder / "s";
    arguments.out = folder / "out";
    arguments.threads = 1;
  }
  test::TemporaryFolder folder;
  RunArguments arguments;
};

TEST_F(RunCommandFunction, WritesTheResultsItReports) {
  test::StreetFiles(folder, 4).write_kitti(true);
  const RunReport report = run(arguments);
  EXPECT_FALSE(report.broken_off);
  EXPECT_FALSE(report.no_result);
  EXPECT_EQ(report.summary["sequence"], "s");
  EXPECT_EQ(report.summary["frames"], 4);
  EXPECT_EQ(report.summary["posed"], 4);
  EXPECT_EQ(json::parse(test::read_file(folder / "out/result.json")), report.summary);
  EXPECT_EQ(read_trajectory(folder / "out/trajectory_optimized.kitti").posed(), 4u);
  for (const char* name : {"graph.g2o", "places.json", "places.dot", "places.graphml", "loops.csv",
                           "plot.png", "map.db", "trajectory_online.tum"})
    EXPECT_TRUE(fs::exists(folder / ("out/" + std::string(name)))) << name;
}

TEST_F(RunCommandFunction, DrawsEveryFrameIfAsked) {
  test::StreetFiles(folder, 3).write_kitti(true);
  arguments.draw = folder / "drawn";
  run(arguments);
  const Image drawn = read_image_as_stored(folder / "drawn/000002.png");
  const Image frame = read_image_as_stored(folder / "s/image_0/000002.png");
  EXPECT_GT(drawn.rows, frame.rows);  // a legend is below
}

TEST_F(RunCommandFunction, DrawsTheFramesAsAVideoOrASheet) {
  test::StreetFiles(folder, 3).write_kitti(true);
  const Image frame = read_image_as_stored(folder / "s/image_0/000002.png");
  arguments.force = true;
  for (const char* name : {"frames.avi", "frames.mp4"}) {
    arguments.draw = folder / name;
    run(arguments);
    const auto video = picture_plugin(name).open_video(arguments.draw);
    ASSERT_NE(video, nullptr) << name;
    int frames = 0;
    for (Image drawn; video->read(drawn); ++frames) EXPECT_GT(drawn.rows, frame.rows);
    EXPECT_EQ(frames, 3) << name;
  }
  for (const char* name : {"frames.png", "frames.jpg"}) {
    arguments.draw = folder / name;
    run(arguments);
    const Image sheet = read_image(arguments.draw).colour;
    EXPECT_GT(sheet.cols, 2.9 * std::min(frame.cols, 480)) << name;
  }
  arguments.force = false;
  arguments.out = folder / "other";
  EXPECT_THAT(message_of<ArgumentError>([&] { run(arguments); }), HasSubstr("exists already"));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST_F(RunCommandFunction, ARunThatFailsLeavesNoVideo) {
  test::StreetFiles(folder, 2).write_kitti(true);
  arguments.draw = folder / "frames.avi";
  folder.write("s/image_0/000000.png", "no image");
  folder.write("s/image_0/000001.png", "no image");
  try {
    run(arguments);
  } catch (const Error&) {  // it may report it either way
  }
  for (const auto& entry : fs::directory_iterator(folder / "."))
    EXPECT_NE(entry.path().extension(), ".avi") << entry.path();
}

TEST_F(RunCommandFunction, KeepsTheResultsBeforeAFrameThatCannotBeRead) {
  test::StreetFiles(folder, 4).write_kitti(true);
  folder.write("s/image_0/000003.png", "no image");
  const RunReport report = run(arguments);
  ASSERT_TRUE(report.broken_off);
  EXPECT_THAT(*report.broken_off, HasSubstr("000003.png"));
  EXPECT_THAT(*report.broken_off, HasSubstr("(results of the 3 frames before it are in "));
  EXPECT_EQ(report.summary["frames"], 3);

  EXPECT_THAT(message_of<ArgumentError>([&] { run(arguments); }),
              HasSubstr("holds an unfinished run; --resume continues it"));
}

TEST_F(RunCommandFunction, SaysWhyNoFrameCouldBePosed) {
  test::StreetFiles(folder, 3).write_kitti(false);
  for (int i = 0; i < 3; ++i)  // nothing to see
    test::write_image(
        folder, "s/image_0/" + test::StreetFiles::name(i),
        Image(test::street_camera().height, test::street_camera().width, CV_8UC1, cv::Scalar(90)));
  const RunReport report = run(arguments);
  ASSERT_TRUE(report.no_result);
  EXPECT_THAT(*report.no_result, HasSubstr("s: no frame could be posed: "));
  EXPECT_EQ(report.summary["posed"], 0);
}

TEST_F(RunCommandFunction, LeavesNoFolderBehindWhereThereIsNothingToRun) {
  fs::create_directories(arguments.sequence);
  EXPECT_THROW(run(arguments), Error);
  EXPECT_FALSE(fs::exists(arguments.out));
}

}  // namespace run_test
}  // namespace placegraph::apps
