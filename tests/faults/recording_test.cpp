#include "tests/faults/recording.h"

#include <placegraph/graph/core/error.h>

#include "tests/faults/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::faults::test {
namespace recording_test {

TEST(FaultRecording, IsReadAsItWasWritten) {
  const placegraph::test::TemporaryFolder folder;
  const Recording written = small_recording();
  write_recording(written, "some_fault", folder / "sequence");
  const Recording read = read_recording(folder / "sequence", {});
  ASSERT_EQ(read.size(), written.size());
  EXPECT_TRUE(equal(read.frames[7].image, written.frames[7].image));
  EXPECT_TRUE(equal(read.frames[7].right, written.frames[7].right));
  EXPECT_LT(cv::norm(read.frames[7].depth, written.frames[7].depth, cv::NORM_INF), 0.00051);
  EXPECT_EQ(read.frames[7].stamp_ns, written.frames[7].stamp_ns);
  EXPECT_TRUE(read.T_world_cam[7].isApprox(written.T_world_cam[7], 1e-6));
  EXPECT_NEAR(read.calibration.baseline_m, 0.2, 1e-9);
  EXPECT_EQ(read.calibration.camera_height_m, 1.5);
  EXPECT_NEAR(read.calibration.camera.cx, 46, 1e-9);
  EXPECT_EQ(placegraph::test::read_file(folder / "sequence/fault.json"),
            "{\"fault\": \"some_fault\", \"first\": 0, \"last\": 59}\n");
}

TEST(FaultRecording, IsNotWrittenIntoAFolderWithContent) {
  const placegraph::test::TemporaryFolder folder;
  folder.write("sequence/notes.txt", "mine");
  EXPECT_THROW(write_recording(small_recording(), "none", folder / "sequence"), ArgumentError);
  EXPECT_EQ(placegraph::test::read_file(folder / "sequence/notes.txt"), "mine");
}

TEST(FaultRecording, StatedDepthUnitIsWrittenAndTheTrueOneIsUsed) {
  const placegraph::test::TemporaryFolder folder;
  Recording recording = small_recording();
  recording.stated_depth_unit_m = 0.01;
  write_recording(recording, "none", folder / "sequence");
  const Recording read = read_recording(folder / "sequence", {});
  EXPECT_NEAR(read.frames[0].depth.at<float>(5, 5), 10 * recording.frames[0].depth.at<float>(5, 5),
              0.01);
}

TEST(FaultRecording, ReadsFewerAndSmallerFrames) {
  const placegraph::test::TemporaryFolder folder;
  write_recording(small_recording(), "none", folder / "sequence");
  ReadingOptions options;
  options.most_frames = 5;
  options.scale = 0.5;
  options.camera_height_m = 3;
  const Recording read = read_recording(folder / "sequence", options);
  EXPECT_EQ(read.size(), 5U);
  EXPECT_EQ(read.T_world_cam.size(), 5U);
  EXPECT_EQ(read.frames[0].image.size(), cv::Size(48, 32));
  EXPECT_EQ(read.frames[0].depth.size(), cv::Size(48, 32));
  EXPECT_NEAR(read.calibration.camera.fx, 40, 1e-9);
  EXPECT_NEAR(read.calibration.camera.cx, 22.75, 1e-9);
  EXPECT_EQ(read.calibration.camera_height_m, 3);
  options.scale = 2;
  EXPECT_THROW(read_recording(folder / "sequence", options), ArgumentError);
}

}  // namespace recording_test
}  // namespace placegraph::faults::test
