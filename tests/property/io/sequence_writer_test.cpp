#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>

#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace sequence_writer_test {

namespace fs = std::filesystem;
using test::message_of;
using test::read_file;
using test::TemporaryFolder;
using ::testing::HasSubstr;

SyntheticWorld small_world(const std::string& name) {
  SyntheticOptions options;
  options.world = name;
  options.frames = 2;
  options.width = 96;
  options.height = 48;
  return SyntheticWorld(options);
}

TEST(SequenceWriter, WhatItWritesOpensAsADatasetWithTheSameContents) {
  const TemporaryFolder folder;
  for (const char* name : {"town-loop", "warehouse"}) {
    const SyntheticWorld world = small_world(name);
    SequenceWriterOptions options;
    options.contents = {true, true, true, true, true};
    std::size_t reported = 0;
    write_sequence(world, folder / name, options, [&](std::size_t done) { reported = done; });
    EXPECT_EQ(reported, 2U);
    const auto dataset = open_dataset(folder / name);
    ASSERT_EQ(dataset->size(), 2U);
    EXPECT_THAT(dataset->sensors(), testing::Contains(Sensor::kStereo));
    EXPECT_THAT(dataset->sensors(), testing::Contains(Sensor::kRgbd));
    EXPECT_EQ(dataset->stamp_ns(1), world.stamp_ns(1));
    const Calibration calibration = dataset->calibration(Sensor::kStereo);
    EXPECT_EQ(calibration.camera_height_m, world.calibration().camera_height_m);
    EXPECT_NEAR(calibration.baseline_m, world.calibration().baseline_m, 1e-8);
    const SyntheticFrame expected = world.render(1, options.contents);
    EXPECT_EQ(
        cv::norm(dataset->frame(1, Sensor::kStereo).image, expected.frame.image, cv::NORM_INF), 0);
    EXPECT_EQ(
        cv::norm(dataset->frame(1, Sensor::kStereo).right, expected.frame.right, cv::NORM_INF), 0);
    // Depth is written in steps of 1/256 m or 1 mm; beyond 255.99 or 65.5 m there is none.
    const Image depth = dataset->frame(1, Sensor::kRgbd).depth;
    const double step = world.is_indoor() ? 0.001 : 1 / 256.0;
    for (int u = 0; u < depth.cols; ++u) {
      const float z = expected.frame.depth.at<float>(40, u);
      EXPECT_NEAR(depth.at<float>(40, u), z < 65534 * step ? z : 0, 0.51 * step + 1e-5);
    }
    ASSERT_TRUE(dataset->ground_truth());
    EXPECT_LT((dataset->ground_truth()->poses[1].T_world_body->matrix() -
               world.ground_truth().poses[1].T_world_body->matrix())
                  .norm(),
              1e-7);
    EXPECT_EQ(fs::exists(folder / (std::string(name) + "/floorplan.json")), world.is_indoor());
  }
}

TEST(SequenceWriter, FlowIsWrittenInKittisForm) {
  const TemporaryFolder folder;
  const SyntheticWorld world = small_world("town-loop");
  SequenceWriterOptions options;
  options.contents.flow = true;
  write_sequence(world, folder / "out", options);
  const cv::Mat file =
      test::read_picture(folder / "out/flow_0/000000.png", DecodedPixels::kAsStored);
  ASSERT_EQ(file.type(), CV_16UC3);
  EXPECT_FALSE(fs::exists(folder / "out/flow_0/000001.png"));  // no next frame
  const Image flow = world.render(0, options.contents).flow;
  const cv::Vec3w bgr = file.at<cv::Vec3w>(44, 20);
  EXPECT_EQ(bgr[0], 1);
  EXPECT_NEAR((bgr[2] - 32768) / 64.0, flow.at<cv::Vec2f>(44, 20)[0], 0.5 / 64);
  EXPECT_NEAR((bgr[1] - 32768) / 64.0, flow.at<cv::Vec2f>(44, 20)[1], 0.5 / 64);
}

TEST(SequenceWriter, NeverReplacesAFolderUnlessForcedAndLeavesNothingHalfDone) {
  const TemporaryFolder folder;
  folder.write("out/precious.txt", "keep");
  const SyntheticWorld world = small_world("corridor-loop");
  SequenceWriterOptions options;
  EXPECT_THAT(message_of<ArgumentError>([&] { write_sequence(world, folder / "out", options); }),
              HasSubstr("is not empty"));
  EXPECT_EQ(read_file(folder / "out/precious.txt"), "keep");
  EXPECT_THAT(message_of<ArgumentError>(
                  [&] { write_sequence(world, folder / "out/precious.txt", options); }),
              HasSubstr("is a file"));
  struct Interruption {};
  options.force = true;
  EXPECT_THROW(
      write_sequence(world, folder / "out", options, [](std::size_t) { throw Interruption(); }),
      Interruption);
  EXPECT_EQ(read_file(folder / "out/precious.txt"), "keep");
  int left = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++left;
  EXPECT_EQ(left, 1);
  write_sequence(world, folder / "out", options);
  EXPECT_EQ(read_file(folder / "out/precious.txt"), "keep");  // no part of a sequence
  EXPECT_TRUE(fs::exists(folder / "out/image_0/000001.png"));
}

}  // namespace sequence_writer_test
}  // namespace placegraph
