#include <gtest/gtest.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/files/picture_file.h>

#include <opencv2/core.hpp>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace picture_file_test {

TEST(WritePng, WritesTheBytesOfTheEncoderWhateverTheName) {
  const test::TemporaryFolder folder;
  Image image(40, 60, CV_8UC1);
  for (int u = 0; u < image.cols; ++u) image.col(u).setTo(3 * u % 50);
  write_png(folder / "a.labels", image);
  EXPECT_EQ(test::read_file(folder / "a.labels"), encode_png(image));
  write_png(folder / "a.png", image, 9);
  EXPECT_EQ(test::read_file(folder / "a.png"), encode_png(image, {.level = 9}));
  EXPECT_NE(encode_png(image, {.level = 9}), encode_png(image));
}

TEST(WriteJpeg, WritesTheBytesOfTheEncoder) {
  const test::TemporaryFolder folder;
  const Image image(16, 16, CV_8UC1, cv::Scalar(7));
  write_jpeg(folder / "a.jpg", image, 90);
  EXPECT_EQ(test::read_file(folder / "a.jpg"), encode_jpeg(image, 90));
}

}  // namespace picture_file_test
}  // namespace placegraph
