#include "apps/support/write_png.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace write_png_test {

TEST(WritePng, WritesTheBytesOfTheEncoderWhateverTheName) {
  const test::TemporaryFolder folder;
  Image image(40, 60, CV_8UC1);
  for (int u = 0; u < image.cols; ++u) image.col(u).setTo(3 * u % 50);
  apps::write_png(folder / "a.labels", image);
  EXPECT_EQ(test::read_file(folder / "a.labels"), encode_png(image));
  apps::write_png(folder / "a.png", image, {.level = 9});
  EXPECT_EQ(test::read_file(folder / "a.png"), encode_png(image, {.level = 9}));
  EXPECT_NE(encode_png(image, {.level = 9}), encode_png(image));
}

}  // namespace write_png_test
}  // namespace placegraph
