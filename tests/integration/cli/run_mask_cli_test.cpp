// `placegraph run --mask`: pixels that no frame uses.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph {
namespace run_mask_cli_test {

using testing::HasSubstr;

/// Two images of 320x240 px with a calibration.
class RunMask : public test::CliTest {
 protected:
  void SetUp() override {
    for (int i = 0; i < 2; ++i)
      test::write_image(dir, "s/" + std::to_string(i) + ".png", test::tiny_grey(320, 240, i));
    dir.write("s/calibration.yaml",
              "width: 320\nheight: 240\nfx: 260\nfy: 260\ncx: 159.5\ncy: 119.5\n");
  }
  Image mask(int width, int height, int grey) {
    return Image(height, width, CV_8UC1, cv::Scalar(grey));
  }
};

TEST_F(RunMask, ThatCannotBeUsedIsRefused) {
  test::write_image(dir, "small.png", mask(160, 120, 255));
  test::write_image(dir, "black.png", mask(320, 240, 0));
  dir.write("text.png", "this is no image");
  expect_usage_error("run s --out out --mask small.png", "small.png");
  expect_usage_error("run s --out out --mask black.png",
                     "black.png: masks the whole image: all pixels are 0");
  expect_usage_error("run s --out out --mask text.png", "text.png");
  expect_usage_error("run s --out out --mask missing.png", "missing.png");
  EXPECT_FALSE(std::filesystem::exists(dir / "out/result.json"));
}

TEST_F(RunMask, LeavesPointsOnlyWhereItIsNotZero) {
  // All of the image but a corner of 20 px: too little to begin with.
  Image corner = mask(320, 240, 0);
  corner(cv::Rect(0, 0, 20, 20)).setTo(255);
  test::write_image(dir, "corner.png", corner);
  test::write_image(dir, "all.png", mask(320, 240, 1));
  const test::CommandResult masked = run("run s --out out --mask corner.png --json");
  EXPECT_EQ(masked.code, 1);
  EXPECT_THAT(masked.err, HasSubstr(" points to track, "));
  const test::CommandResult unmasked = run("run s --out out2 --mask all.png --json");
  EXPECT_THAT(unmasked.err, testing::Not(HasSubstr(" points to track, ")));
}

TEST_F(RunMask, IsAnOptionOfFilesToo) {
  test::write_image(dir, "small.png", mask(160, 120, 255));
  dir.write("o.yaml", "mask: small.png\n");
  expect_usage_error("run s --out out --config o.yaml", "small.png");
}

}  // namespace run_mask_cli_test
}  // namespace placegraph
