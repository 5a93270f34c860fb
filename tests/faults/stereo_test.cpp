#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace stereo_test {

TEST(FaultStereo, ExchangesTheCamerasWithTheirPoses) {
  const Recording recording = small_recording(), out = faulty(recording, "cameras_swapped");
  EXPECT_TRUE(equal(out.frames[3].image, recording.frames[3].right));
  EXPECT_TRUE(equal(out.frames[3].right, recording.frames[3].image));
  EXPECT_NEAR((out.T_world_cam[3].translation() - recording.T_world_cam[3].translation()).norm(),
              0.2, 1e-9);
}

TEST(FaultStereo, TakesTheRightImageOfAnotherFrame) {
  const Recording recording = small_recording();
  const auto right = [&](const char* name, std::size_t i) {
    return faulty(recording, name).frames[i].right;
  };
  EXPECT_TRUE(equal(right("right_late", 9), recording.frames[8].right));
  EXPECT_TRUE(equal(right("right_late", 0), recording.frames[0].right));
  EXPECT_TRUE(equal(right("right_early", 9), recording.frames[10].right));
  EXPECT_TRUE(equal(right("right_late_later", 29), recording.frames[29].right));
  EXPECT_TRUE(equal(right("right_late_later", 30), recording.frames[29].right));
}

TEST(FaultStereo, LeavesTheLeftImageAsItIs) {
  const Recording recording = small_recording();
  for (const Fault& fault : stereo_faults()) {
    if (fault.name == "cameras_swapped") continue;
    SCOPED_TRACE(fault.name);
    EXPECT_TRUE(equal(fault.apply(recording, 1).frames[40].image, recording.frames[40].image));
  }
}

TEST(FaultStereo, MovesAndRotatesTheRightImage) {
  const Recording recording = small_recording();
  const Image& image = recording.frames[4].right;
  const auto right = [&](const char* name) { return faulty(recording, name).frames[4].right; };
  EXPECT_TRUE(equal(right("right_rows_3").rowRange(3, 64), image.rowRange(0, 61)));
  EXPECT_TRUE(equal(right("right_rows_6").rowRange(6, 64), image.rowRange(0, 58)));
  const Image rotated = right("right_rotated");
  EXPECT_LE(std::abs(rotated.at<uchar>(32, 48) - image.at<uchar>(32, 48)), 2);
  EXPECT_GT(changed_fraction(rotated, image), 0.5);
}

TEST(FaultStereo, SpoilsTheRightImage) {
  const Recording recording = small_recording();
  const auto right = [&](const char* name, std::size_t i = 4) {
    return faulty(recording, name).frames[i].right;
  };
  EXPECT_EQ(mean_of(right("right_black")), 0);
  EXPECT_EQ(mean_of(right("right_black_later", 40)), 0);
  EXPECT_GT(mean_of(right("right_black_later", 20)), 0);
  EXPECT_TRUE(equal(right("right_is_left"), recording.frames[4].image));
  EXPECT_NEAR(mean_of(right("right_exposure")) / mean_of(recording.frames[4].right), 0.33, 0.02);
  EXPECT_LT(contrast_of(right("right_blurred")), contrast_of(recording.frames[4].right));
}

}  // namespace stereo_test
}  // namespace placegraph::faults::test
