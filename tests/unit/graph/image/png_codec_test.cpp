#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/image/png_codec.h>
#include <zlib.h>

#include <opencv2/core.hpp>

#include "damage.h"
#include "png_kinds.h"
#include "same_image.h"

namespace placegraph {
namespace png_codec_test {

using test::same_image;

constexpr DecodedPixels kAllPixels[] = {DecodedPixels::kAsStored, DecodedPixels::kGreyOrColour,
                                        DecodedPixels::kEightBits};
// Numbers of cv::ImwriteFlags.
constexpr int kPngCompression = 16, kPngStrategy = 17, kPngStrategyRle = 3;

/// What cv::imdecode() makes of the bytes.
Image opencv_image(const std::string& bytes, DecodedPixels pixels) {
  return picture_plugin("a test").decode(bytes, pixels);
}

std::string opencv_bytes(const Image& image, const std::vector<int>& settings) {
  return picture_plugin("a test").encode(".png", image, settings);
}

std::string replaced_size(std::string png, std::uint32_t width, std::uint32_t height) {
  const auto store = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) png[at + i] = static_cast<char>(value >> (24 - 8 * i));
  };
  store(16, width);
  store(20, height);
  store(29,
        static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(png.data()) + 12, 17)));
  return png;
}

TEST(PngCodec, DecodesEveryKindOfEverySizeToTheBitsOfOpenCv) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {5, 5}, {7, 1}, {1, 9}, {64, 33}})
    for (const test::PngKind& kind : test::all_png_kinds(width, height)) {
      const std::string bytes = test::make_png(kind);
      for (const DecodedPixels pixels : kAllPixels) {
        const Image image = decode_png(bytes, pixels);
        ASSERT_EQ(image.size(), cv::Size(width, height)) << name_of(kind);
        ASSERT_TRUE(same_image(image, opencv_image(bytes, pixels)))
            << name_of(kind) << ", pixels " << static_cast<int>(pixels);
      }
    }
}

TEST(PngCodec, KeepsOrLeavesOutAlphaAndDepthAsAsked) {
  const std::string deep = test::make_png({PNG_COLOR_TYPE_RGB_ALPHA, 16, false, false, 9, 8});
  EXPECT_EQ(decode_png(deep, DecodedPixels::kAsStored).type(), CV_16UC4);
  EXPECT_EQ(decode_png(deep, DecodedPixels::kGreyOrColour).type(), CV_16UC3);
  EXPECT_EQ(decode_png(deep, DecodedPixels::kEightBits).type(), CV_8UC3);
  const std::string grey = test::make_png({PNG_COLOR_TYPE_GRAY, 2, false, true, 9, 8});
  EXPECT_EQ(decode_png(grey, DecodedPixels::kAsStored).type(), CV_8UC1);
}

TEST(PngCodec, EncodesEveryTypeToTheBytesOfOpenCv) {
  cv::RNG random(3);
  for (const int depth : {CV_8U, CV_16U})
    for (const int channels : {1, 3, 4})
      for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 7), cv::Size(130, 97)})
        for (const double spread : {3.0, 60000.0}) {
          Image image(size, CV_MAKETYPE(depth, channels));
          random.fill(image, cv::RNG::UNIFORM, 0, spread);
          ASSERT_EQ(encode_png(image), opencv_bytes(image, {}));
          for (const int level : {0, 1, 3, 9}) {
            ASSERT_EQ(encode_png(image, {.level = level}),
                      opencv_bytes(image, {kPngCompression, level}));
            ASSERT_EQ(encode_png(image, {.level = level, .runs_only = true}),
                      opencv_bytes(image, {kPngCompression, level, kPngStrategy, kPngStrategyRle}));
          }
          const Image part = image(cv::Rect(0, 0, (size.width + 1) / 2, size.height));
          ASSERT_TRUE(same_image(decode_png(encode_png(part), DecodedPixels::kAsStored), part));
        }
}

TEST(PngCodec, RefusesToEncodeWhatNoPngHolds) {
  EXPECT_THROW(encode_png(Image()), ArgumentError);
  EXPECT_THROW(encode_png(Image(4, 4, CV_32FC1)), ArgumentError);
  EXPECT_THROW(encode_png(Image(4, 4, CV_8UC2)), ArgumentError);
  EXPECT_THROW(encode_png(Image(4, 4, CV_8UC1), {.level = 10}), ArgumentError);
}

TEST(PngCodec, AFileCutAnywhereGivesNoImage) {
  for (const test::PngKind& kind : test::all_png_kinds(11, 6)) {
    const std::string bytes = test::make_png(kind);
    ASSERT_FALSE(is_truncated_png(bytes));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::string_view cut(bytes.data(), length);
      ASSERT_TRUE(decode_png(cut, DecodedPixels::kAsStored).empty()) << name_of(kind) << length;
      ASSERT_EQ(is_truncated_png(cut), length < bytes.size() - 4);
    }
  }
}

TEST(PngCodec, OfDamagedFilesItReadsThoseThatOpenCvReads) {
  std::mt19937 random(5);
  for (const test::PngKind& kind : test::all_png_kinds(23, 17)) {
    const std::string bytes = test::make_png(kind);
    for (int i = 0; i < 40; ++i) {
      const std::string other = test::damaged(bytes, random);
      ASSERT_TRUE(same_image(decode_png(other, DecodedPixels::kEightBits),
                             opencv_image(other, DecodedPixels::kEightBits)))
          << name_of(kind) << ", " << i;
    }
  }
}

TEST(PngCodec, RefusesSizesThatTheFileCannotHold) {
  const std::string bytes = test::make_png({PNG_COLOR_TYPE_GRAY, 8, false, false, 30, 20});
  EXPECT_FALSE(decode_png(replaced_size(bytes, 30, 20), DecodedPixels::kAsStored).empty());
  for (const auto& [width, height] : {std::pair{0u, 20u},
                                      {30u, 0u},
                                      {30u, 21u},
                                      {32000u, 32000u},
                                      {40000u, 40000u},
                                      {30u, 1u << 21},
                                      {1u << 21, 20u},
                                      {1u << 30, 1u << 30},
                                      {0xffffffffu, 0xffffffffu}})
    EXPECT_TRUE(decode_png(replaced_size(bytes, width, height), DecodedPixels::kAsStored).empty())
        << width << "x" << height;
}

TEST(PngCodec, KnowsAPngByItsFirstBytes) {
  EXPECT_TRUE(is_png(encode_png(Image(2, 2, CV_8UC1, cv::Scalar(1)))));
  EXPECT_FALSE(is_png("\xff\xd8\xff"));
  EXPECT_FALSE(is_png(""));
  EXPECT_TRUE(decode_png("no picture", DecodedPixels::kAsStored).empty());
  EXPECT_TRUE(decode_png("", DecodedPixels::kAsStored).empty());
}

}  // namespace png_codec_test
}  // namespace placegraph
