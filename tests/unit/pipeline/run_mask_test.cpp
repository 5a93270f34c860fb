#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run_mask.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph {
namespace run_mask_test {

using namespace test;

const Camera kCamera = pinhole(64, 48, 50);

Image mask_without(const cv::Rect& masked) {
  Image mask(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(200));
  mask(masked).setTo(0);
  return mask;
}

TEST(RunMask, MasksNothingWithoutAFile) {
  Frame frame;
  RunMask("", kCamera).apply(frame);
  EXPECT_TRUE(frame.mask.empty());
}

TEST(RunMask, IsCombinedWithTheMaskOfAFrame) {
  TemporaryFolder dir;
  write_image(dir, "m.png", mask_without({0, 0, 10, 10}));
  const RunMask mask(dir / "m.png", kCamera);
  Frame frame;
  mask.apply(frame);
  EXPECT_EQ(cv::countNonZero(frame.mask), 64 * 48 - 100);
  const Image given = mask_without({20, 20, 5, 5});
  frame.mask = given.clone();
  mask.apply(frame);
  EXPECT_EQ(cv::countNonZero(frame.mask), 64 * 48 - 125);
}

TEST(RunMask, RefusesFilesThatAreNoMaskOfTheImages) {
  TemporaryFolder dir;
  write_image(dir, "small.png", Image(24, 32, CV_8UC1, cv::Scalar(255)));
  write_image(dir, "black.png", mask_without({0, 0, 64, 48}));
  for (const char* name : {"small.png", "black.png", "missing.png"})
    EXPECT_THROW(RunMask(dir / name, kCamera), FileError) << name;
}

}  // namespace run_mask_test
}  // namespace placegraph
