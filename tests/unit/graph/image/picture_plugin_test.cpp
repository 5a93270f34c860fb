#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture_plugin.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <thread>

#include "same_image.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace picture_plugin_test {

using test::message_of;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A folder beside this program.
std::string beside(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

Image ramp(int type) {
  Image image(9, 12, type);
  cv::RNG random(2);
  random.fill(image, cv::RNG::UNIFORM, 0, 65536);
  return image;
}

TEST(PicturePlugin, IsLoadedOnceForAllThreads) {
  std::vector<const PicturePlugin*> found(8);
  std::vector<std::thread> threads;
  for (auto& plugin : found)
    threads.emplace_back([&plugin] { plugin = &picture_plugin("a test"); });
  for (std::thread& thread : threads) thread.join();
  for (const PicturePlugin* plugin : found) EXPECT_EQ(plugin, &picture_plugin("a test"));
}

TEST(PicturePlugin, AMissingModuleIsReportedInOneLineWithThePathToRead) {
  const TemporaryFolder folder;
  const std::string message = message_of([&] {
    load_picture_plugin({folder / "a", folder / "b"}, "views/x.bmp");
  });
  EXPECT_THAT(message,
              AllOf(StartsWith("views/x.bmp: needs the module libplacegraph_opencv_plugin"),
                    HasSubstr(folder / "a, "), HasSubstr(folder / "b "),
                    HasSubstr("libopencv-videoio406"), Not(HasSubstr("\n"))));
  EXPECT_THROW(load_picture_plugin({}, "x.bmp"), FileError);
}

TEST(PicturePlugin, AModuleOfAnotherVersionOrNoneIsRefused) {
  const TemporaryFolder folder;
  folder.write(kPicturePluginFile, "no shared library");
  EXPECT_THAT(message_of([&] { load_picture_plugin({folder / "."}, "x.bmp"); }),
              AllOf(StartsWith("x.bmp: needs the module"), HasSubstr("cannot be loaded ("),
                    Not(HasSubstr("\n"))));
  EXPECT_THAT(message_of([&] { load_picture_plugin({beside("other_version")}, "x.bmp"); }),
              HasSubstr("other_version/libplacegraph_opencv_plugin.so is of version 7, and " +
                        std::to_string(kPicturePluginVersion) + " is needed"));
  EXPECT_THAT(message_of([&] { load_picture_plugin({beside("no_plugin")}, "x.bmp"); }),
              HasSubstr("is no module of placegraph"));
}

TEST(PicturePlugin, ALaterFolderHelpsWhereAnEarlierOneHoldsAnotherVersion) {
  const PicturePlugin& plugin = picture_plugin("a test");
  std::string folder = beside("");
  for (int i = 0; i < 6 && !std::filesystem::exists(folder + "lib/placegraph"); ++i)
    folder += "../";
  EXPECT_EQ(&load_picture_plugin({beside("other_version"), folder + "lib/placegraph"}, "x.bmp"),
            &plugin);
}

TEST(PicturePlugin, ReadsWhatItWritesInOtherFormats) {
  const PicturePlugin& plugin = picture_plugin("a test");
  for (const auto& [extension, type] : {std::pair{".bmp", CV_8UC3},
                                        {".bmp", CV_8UC1},
                                        {".pgm", CV_8UC1},
                                        {".pgm", CV_16UC1},
                                        {".ppm", CV_8UC3},
                                        {".tif", CV_16UC1},
                                        {".tiff", CV_8UC3}}) {
    const std::string bytes = plugin.encode(extension, ramp(type), {});
    EXPECT_TRUE(test::same_image(plugin.decode(bytes, DecodedPixels::kAsStored), ramp(type)))
        << extension;
    EXPECT_EQ(plugin.decode(bytes, DecodedPixels::kEightBits).depth(), CV_8U);
    EXPECT_EQ(plugin.decode(bytes, DecodedPixels::kGreyOrColour).type(), type);
  }
}

TEST(PicturePlugin, GivesNothingForWhatIsNoPictureVideoOrFormat) {
  const PicturePlugin& plugin = picture_plugin("a test");
  const TemporaryFolder folder;
  folder.write("text.avi", "no video");
  EXPECT_TRUE(plugin.decode("no picture", DecodedPixels::kAsStored).empty());
  EXPECT_TRUE(plugin.decode("", DecodedPixels::kAsStored).empty());
  EXPECT_TRUE(plugin.encode(".what", ramp(CV_8UC1), {}).empty());
  EXPECT_TRUE(plugin.encode(".bmp", Image(), {}).empty());
  EXPECT_EQ(plugin.open_video(folder / "text.avi"), nullptr);
  EXPECT_EQ(plugin.open_video(folder / "missing.avi"), nullptr);
  EXPECT_FALSE(plugin.write_video(folder / "none.avi", {}, 10));
}

TEST(PicturePlugin, ReadsTheFramesOfAVideoInTheirOrder) {
  const PicturePlugin& plugin = picture_plugin("a test");
  const TemporaryFolder folder;
  std::vector<Image> frames;
  for (int i = 0; i < 4; ++i) frames.emplace_back(48, 64, CV_8UC3, cv::Scalar::all(60 * i + 10));
  ASSERT_TRUE(plugin.write_video(folder / "v.avi", frames, 25));
  const auto video = plugin.open_video(folder / "v.avi");
  ASSERT_NE(video, nullptr);
  EXPECT_NEAR(video->rate_hz(), 25, 1e-6);
  EXPECT_EQ(video->announced_frames(), 4);
  Image frame;
  ASSERT_TRUE(video->grab());
  ASSERT_TRUE(video->read(frame));
  EXPECT_NEAR(cv::mean(frame)[0], 70, 3);
  EXPECT_NEAR(video->time_ms(), 40, 1e-6);
  EXPECT_TRUE(video->grab());
  EXPECT_TRUE(video->grab());
  EXPECT_FALSE(video->grab());
  EXPECT_FALSE(video->read(frame));
}

TEST(PicturePlugin, WritesAVideoFrameByFrame) {
  const PicturePlugin& plugin = picture_plugin("a test");
  const TemporaryFolder folder;
  for (const char* name : {"v.avi", "v.mp4"}) {
    const auto writer = plugin.create_video(folder / name, 64, 48, 10);
    ASSERT_NE(writer, nullptr) << name;
    for (int i = 0; i < 5; ++i)
      EXPECT_TRUE(writer->write(Image(48, 64, CV_8UC3, cv::Scalar::all(40 * i + 20))));
    EXPECT_FALSE(writer->write(Image(48, 62, CV_8UC3)));
    EXPECT_FALSE(writer->write(Image()));
    EXPECT_TRUE(writer->finish());
    const auto video = plugin.open_video(folder / name);
    ASSERT_NE(video, nullptr) << name;
    EXPECT_NEAR(video->rate_hz(), 10, 1e-6);
    Image frame;
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(video->read(frame)) << name << ' ' << i;
      EXPECT_NEAR(cv::mean(frame)[0], 40 * i + 20, 5) << name;
    }
    EXPECT_FALSE(video->read(frame));
  }
  EXPECT_EQ(plugin.create_video(folder / "v.txt", 64, 48, 10), nullptr);
  EXPECT_EQ(plugin.create_video(folder / "none/v.avi", 64, 48, 10), nullptr);
}

}  // namespace picture_plugin_test
}  // namespace placegraph
