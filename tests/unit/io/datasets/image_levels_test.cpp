#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/datasets/image_levels.h>
#include <placegraph/io/files/image_file.h>

#include "tiny_images.h"

namespace placegraph {
namespace image_levels_test {

using test::TemporaryFolder;
using test::write_image;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Images of 16 bits whose pixels count up from `least` to `greatest`.
Image ramp_16(int least, int greatest) {
  Image image(16, 16, CV_16UC1);
  for (int i = 0; i < 256; ++i)
    image.at<std::uint16_t>(i / 16, i % 16) =
        static_cast<std::uint16_t>(least + (greatest - least) * i / 255);
  return image;
}

TEST(ImageLevels, OfEightBitsAreAllUsed) {
  const TemporaryFolder folder;
  const ImageLevels levels =
      sample_levels({write_image(folder, "a.png", test::tiny_grey(64, 48, 1))});
  EXPECT_FALSE(levels.of_16);
  EXPECT_EQ(levels.bits, 16);
  EXPECT_THAT(levels.notes, IsEmpty());
}

TEST(ImageLevels, OfTwelveBitsKeepTheUpperEightExactly) {
  const TemporaryFolder folder;
  const std::string path = write_image(folder, "a.png", ramp_16(0, 4080));
  const ImageLevels levels = sample_levels({path});
  EXPECT_TRUE(levels.of_16);
  EXPECT_EQ(levels.bits, 12);
  ASSERT_THAT(levels.notes, SizeIs(1));
  EXPECT_THAT(levels.notes[0].text, HasSubstr("use only 12 bits (up to 4080)"));
  const Image grey = read_image(path, levels.bits).grey;
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(grey.at<std::uint8_t>(i / 16, i % 16), 4080 * i / 255 / 16) << i;
}

TEST(ImageLevels, AreOneNumberForTheSequence) {
  // The brightest image of ten says how many bits are in use; with 16 bits every image may be it.
  const TemporaryFolder folder;
  std::vector<std::string> paths;
  for (int i = 0; i < 8; ++i)
    paths.push_back(
        write_image(folder, std::to_string(i) + ".png", ramp_16(0, i == 5 ? 1020 : 500)));
  EXPECT_EQ(sample_levels(paths).bits, 10);
}

TEST(ImageLevels, DarkAndFlatImagesAreReported) {
  const TemporaryFolder folder;
  const Image dark = test::tiny_grey(64, 48, 1) / 10;
  ImageLevels levels = sample_levels({write_image(folder, "dark.png", dark)});
  ASSERT_THAT(levels.notes, SizeIs(1));
  EXPECT_THAT(levels.notes[0].text, HasSubstr("very dark"));
  const Image flat(48, 64, CV_8UC1, cv::Scalar(120));
  levels = sample_levels({write_image(folder, "flat.png", flat)});
  ASSERT_THAT(levels.notes, SizeIs(1));
  EXPECT_THAT(levels.notes[0].text, HasSubstr("hardly any contrast"));
}

TEST(ImageLevels, PassOverWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(sample_levels({folder.write("a.png", "no image")}).notes, IsEmpty());
  EXPECT_THAT(sample_levels({}).notes, IsEmpty());
}

}  // namespace image_levels_test
}  // namespace placegraph
