#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/picture.h>
#include <placegraph/graph/image/png_codec.h>

#include <opencv2/core.hpp>

#include "same_image.h"
#include "tests/support/message_of.h"

namespace placegraph {
namespace picture_test {

using test::message_of;
using test::same_image;

const Image& checkered() {
  static const Image image = [] {
    Image board(16, 24, CV_8UC3, cv::Scalar(10, 60, 200));
    board(cv::Rect(4, 4, 8, 8)).setTo(cv::Scalar(250, 30, 0));
    return board;
  }();
  return image;
}

TEST(Picture, TheFormatFollowsTheExtensionWhateverItsCase) {
  EXPECT_TRUE(is_png(encode_picture("a/b.png", checkered())));
  EXPECT_TRUE(is_png(encode_picture("B.PNG", checkered())));
  EXPECT_TRUE(is_jpeg(encode_picture("b.jpg", checkered())));
  EXPECT_TRUE(is_jpeg(encode_picture("b.JPEG", checkered())));
  EXPECT_THAT(encode_picture("b.Bmp", checkered()), testing::StartsWith("BM"));
}

TEST(Picture, AnExtensionOfNoFormatIsRefused) {
  for (const char* path : {"a.what", "png", ""})
    EXPECT_THAT(message_of([&] { encode_picture(path, checkered()); }),
                testing::HasSubstr(": cannot be written as a picture"));
}

TEST(Picture, WhatIsReadIsWhatWasWritten) {
  for (const char* path : {"a.png", "a.bmp", "a.ppm", "a.tif"})
    EXPECT_TRUE(same_image(
        decode_picture(encode_picture(path, checkered()), DecodedPixels::kAsStored, path),
        checkered()))
        << path;
}

TEST(Picture, WhatIsNoPictureGivesAnEmptyImage) {
  for (const char* bytes : {"no picture", "\x89PNG and no more IEND", "\xff\xd8 \xff\xd9", "BM"})
    EXPECT_TRUE(decode_picture(bytes, DecodedPixels::kEightBits, "a").empty()) << bytes;
}

TEST(Picture, OnlyPngAndJpegAreKnownToBeTruncated) {
  for (const char* path : {"a.png", "a.jpg"}) {
    const std::string bytes = encode_picture(path, checkered());
    EXPECT_FALSE(is_truncated_picture(bytes));
    EXPECT_TRUE(is_truncated_picture(std::string_view(bytes).substr(0, bytes.size() - 9)));
  }
  EXPECT_FALSE(is_truncated_picture("no picture"));
  EXPECT_FALSE(is_truncated_picture(""));
}

}  // namespace picture_test
}  // namespace placegraph
