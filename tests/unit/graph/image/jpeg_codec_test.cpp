#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/picture_plugin.h>

#include <opencv2/core.hpp>

#include "damage.h"
#include "jpeg_kinds.h"
#include "same_image.h"

namespace placegraph {
namespace jpeg_codec_test {

using test::same_image;

/// What cv::imdecode() makes of the bytes.
Image opencv_image(const std::string& bytes) {
  return picture_plugin("a test").decode(bytes, DecodedPixels::kEightBits);
}

/// The place of the two bytes of a marker in a JPEG.
std::size_t marker_at(const std::string& bytes, char marker) {
  return bytes.find(std::string("\xff") + marker);
}

TEST(JpegCodec, DecodesEveryKindOfEverySizeToTheBitsOfOpenCv) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {8, 8}, {17, 5}, {9, 70}, {121, 37}})
    for (const test::JpegKind& kind : test::all_jpeg_kinds(width, height)) {
      const std::string bytes = test::make_jpeg(kind);
      const Image image = decode_jpeg(bytes);
      ASSERT_EQ(image.size(), cv::Size(width, height)) << name_of(kind);
      ASSERT_EQ(image.type(), kind.stored == JCS_GRAYSCALE ? CV_8UC1 : CV_8UC3) << name_of(kind);
      ASSERT_TRUE(same_image(image, opencv_image(bytes))) << name_of(kind);
      ASSERT_TRUE(
          same_image(image, picture_plugin("a test").decode(bytes, DecodedPixels::kAsStored)))
          << name_of(kind);
    }
}

TEST(JpegCodec, EncodesWhatItDecodes) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    Image image(48, 160, type);
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols * image.channels(); ++u)
        image.ptr(v)[u] = static_cast<std::uint8_t>(40 + v + u / image.channels() / 2 +
                                                    30 * (u % image.channels()));
    const std::string bytes = encode_jpeg(image, 90);
    EXPECT_TRUE(is_jpeg(bytes));
    EXPECT_FALSE(is_truncated_jpeg(bytes));
    const Image decoded = decode_jpeg(bytes);
    ASSERT_EQ(decoded.type(), type);
    ASSERT_EQ(decoded.size(), image.size());
    EXPECT_LT(cv::norm(image, decoded, cv::NORM_INF), 12);
    EXPECT_LT(encode_jpeg(image, 10).size(), bytes.size());
  }
  EXPECT_THROW((void)encode_jpeg(Image(), 80), ArgumentError);
  EXPECT_THROW((void)encode_jpeg(Image(4, 4, CV_16UC1), 80), ArgumentError);
  EXPECT_THROW((void)encode_jpeg(Image(4, 4, CV_8UC1), 101), ArgumentError);
}

TEST(JpegCodec, AFileCutAnywhereIsReportedAndGivesNoImageWhereRowsAreMissing) {
  for (const test::JpegKind& kind : test::all_jpeg_kinds(19, 10)) {
    if (kind.horizontal != kind.vertical || kind.restart_rows == 0) continue;
    const std::string bytes = test::make_jpeg(kind);
    const Image whole = decode_jpeg(bytes);
    ASSERT_FALSE(is_truncated_jpeg(bytes));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::string_view cut(bytes.data(), length);
      ASSERT_TRUE(is_truncated_jpeg(cut)) << name_of(kind) << ", " << length;
      const Image image = decode_jpeg(cut);
      ASSERT_TRUE(image.empty() || same_image(image, whole)) << name_of(kind) << ", " << length;
      ASSERT_TRUE(image.empty() || length > bytes.size() - 8) << name_of(kind) << ", " << length;
    }
  }
}

TEST(JpegCodec, OfDamagedFilesItReadsWhatOpenCvReadsOrNothing) {
  std::mt19937 random(5);
  int pictures = 0, refused = 0;
  for (const test::JpegKind& kind : test::all_jpeg_kinds(40, 23)) {
    const std::string bytes = test::make_jpeg(kind);
    const std::size_t scan = marker_at(bytes, '\xda');
    for (int i = 0; i < 10; ++i) {
      // Behind the first scan's head, and anywhere.
      const std::string other = test::damaged(bytes, random, i % 2 ? scan + 14 : 0);
      const Image image = decode_jpeg(other);
      ++(image.empty() ? refused : pictures);
      ASSERT_TRUE(image.empty() || same_image(image, opencv_image(other)))
          << name_of(kind) << ", " << i;
    }
  }
  EXPECT_GT(pictures, 50);
  EXPECT_GT(refused, 50);
}

TEST(JpegCodec, RefusesPixelsThatAreMissingOrOverwritten) {
  const std::string bytes = test::make_jpeg({.stored = JCS_YCbCr, .width = 160, .height = 120});
  const std::size_t scan = marker_at(bytes, '\xda') + 14, data = bytes.size() - 2 - scan;
  ASSERT_FALSE(decode_jpeg(bytes).empty());
  std::string missing = bytes;
  missing.erase(scan + data / 3, data / 3);
  EXPECT_TRUE(decode_jpeg(missing).empty());
  const std::string ends_early = bytes.substr(0, scan + data / 2) + "\xff\xd9";
  EXPECT_TRUE(decode_jpeg(ends_early).empty());
  std::string overwritten = bytes;
  for (std::size_t i = scan + data / 3; i < scan + data / 2; ++i)
    overwritten[i] = static_cast<char>(37 * i);
  EXPECT_TRUE(decode_jpeg(overwritten).empty());
}

TEST(JpegCodec, TakesStrayBytesBehindAndBeforeTheEndMark) {
  const std::string bytes = test::make_jpeg({.stored = JCS_YCbCr, .width = 40, .height = 24});
  const Image image = decode_jpeg(bytes);
  EXPECT_TRUE(same_image(decode_jpeg(bytes + std::string(1000, 'x')), image));
  std::string before_end = bytes;
  before_end.insert(bytes.size() - 2, 2, '\0');
  EXPECT_TRUE(same_image(decode_jpeg(before_end), image));
}

TEST(JpegCodec, RefusesSizesThatTheFileCannotHold) {
  std::string bytes = test::make_jpeg({.stored = JCS_GRAYSCALE, .width = 40, .height = 24});
  const std::size_t frame = marker_at(bytes, '\xc0');
  for (const std::size_t i : {5, 7}) bytes[frame + i] = '\xf0';  // 61464 x 61480
  EXPECT_TRUE(decode_jpeg(bytes).empty());
  for (const std::size_t i : {5, 7}) bytes[frame + i] = '\x40';  // 16408 x 16424
  EXPECT_TRUE(decode_jpeg(bytes).empty());
  for (const std::size_t i : {5, 6}) bytes[frame + i] = '\0';
  EXPECT_TRUE(decode_jpeg(bytes).empty());
}

TEST(JpegCodec, TheEndOfAThumbnailIsNotThatOfTheImage) {
  const std::string bytes = test::make_jpeg({.stored = JCS_YCbCr, .width = 20, .height = 20});
  const std::string thumbnail("\xff\xd8\xff\xe1\x00\x06\xff\xd9\x00\x00", 10);
  EXPECT_FALSE(is_truncated_jpeg(thumbnail + bytes.substr(2)));
  EXPECT_TRUE(is_truncated_jpeg(thumbnail + bytes.substr(2, bytes.size() - 10)));
}

TEST(JpegCodec, KnowsAJpegByItsFirstBytes) {
  EXPECT_TRUE(is_jpeg(test::make_jpeg({.width = 8, .height = 8})));
  EXPECT_FALSE(is_jpeg("\x89PNG"));
  EXPECT_FALSE(is_jpeg(""));
  EXPECT_TRUE(decode_jpeg("no picture").empty());
  EXPECT_TRUE(decode_jpeg("").empty());
  EXPECT_TRUE(decode_jpeg("\xff\xd8").empty());
}

}  // namespace jpeg_codec_test
}  // namespace placegraph
