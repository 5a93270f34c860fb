#include <gmock/gmock.h>
#include <placegraph/io/files/image_file.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace image_file_test {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

Image colours() {
  Image image(5, 7, CV_8UC3);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image.at<cv::Vec3b>(v, u) =
          cv::Vec3b(cv::saturate_cast<uchar>(30 * u), 90, cv::saturate_cast<uchar>(50 * v));
  return image;
}

TEST(ImageFile, WhatIsWrittenIsReadAgainInEveryFormatWithoutLoss) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.bmp", "a.ppm", "a.tiff"}) {
    write_image(folder / name, colours());
    EXPECT_EQ(cv::norm(read_image_as_stored(folder / name), colours(), cv::NORM_INF), 0) << name;
    EXPECT_EQ(cv::norm(read_image(folder / name).colour, colours(), cv::NORM_INF), 0) << name;
  }
}

TEST(ImageFile, AFailedWriteLeavesTheFileAsItWas) {
  const TemporaryFolder folder;
  folder.write("a.what", "precious");
  EXPECT_THAT(message_of([&] { write_image(folder / "a.what", colours()); }),
              HasSubstr("a.what: cannot be written as a picture"));
  EXPECT_EQ(test::read_file(folder / "a.what"), "precious");
  EXPECT_THAT(message_of([&] { write_image(folder / "none/a.png", colours()); }),
              HasSubstr("none/a.png: cannot be written"));
  EXPECT_FALSE(fs::exists(folder / "none"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(ImageFile, OfSixteenBitsTheUpperEightAreKept) {
  const TemporaryFolder folder;
  const Image deep(6, 8, CV_16UC1, cv::Scalar(0x0abc));
  for (const char* name : {"a.png", "a.pgm", "a.tif"}) {
    write_image(folder / name, deep);
    EXPECT_EQ(read_image(folder / name).grey.at<uchar>(2, 3), 0x0a) << name;
    EXPECT_EQ(read_image(folder / name, 12).grey.at<uchar>(2, 3), 0xab) << name;
    EXPECT_EQ(read_image_as_stored(folder / name).at<std::uint16_t>(2, 3), 0x0abc) << name;
  }
}

}  // namespace image_file_test
}  // namespace placegraph
