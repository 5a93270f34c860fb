#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/camera_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace camera_file_test {

TEST(CameraFile, ReadsSixNumbersAfterAComment) {
  const test::TemporaryFolder dir;
  const Camera camera = read_camera_file(
      dir.write("K.txt", "# fx fy cx cy width height\n500.5 501 320 240 640 480\n"));
  EXPECT_EQ(camera.fx, 500.5);
  EXPECT_EQ(camera.fy, 501);
  EXPECT_EQ(camera.cx, 320);
  EXPECT_EQ(camera.cy, 240);
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.distortion, Distortion::kNone);
}

TEST(CameraFile, NamesWhatIsWrong) {
  const test::TemporaryFolder dir;
  const auto message = [&](const std::string& text) {
    const std::string path = dir.write("K.txt", text);
    return test::message_of([&] { (void)read_camera_file(path); });
  };
  EXPECT_THAT(message(""), testing::HasSubstr("K.txt: no camera in it"));
  EXPECT_THAT(message("500 500 320 240 640\n"), testing::HasSubstr("K.txt:1: a camera has 6"));
  EXPECT_THAT(message("500 500 320 x 640 480\n"), testing::HasSubstr("K.txt:1: cy"));
  EXPECT_THAT(message("500 500 320 240 640.5 480\n"), testing::HasSubstr("K.txt:1: width"));
  EXPECT_THAT(message("500 500 320 240 0 480\n"), testing::HasSubstr("K.txt:1: width and height"));
  EXPECT_THAT(message("0 500 320 240 640 480\n"), testing::HasSubstr("K.txt:1: "));
  EXPECT_THAT(message("nan 500 320 240 640 480\n"), testing::HasSubstr("K.txt:1: fx"));
  EXPECT_THAT(message("500 500 320 240 640 480\n1 1 1 1 1 1\n"),
              testing::HasSubstr("K.txt:2: one camera expected"));
  EXPECT_THROW((void)read_camera_file(dir / "absent.txt"), FileError);
}

}  // namespace camera_file_test
}  // namespace placegraph
