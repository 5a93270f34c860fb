#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace overlay_test {

double fraction(const Recording& recording, const std::string& name) {
  const Recording out = faulty(recording, name);
  const std::size_t i = out.faulty.first;
  return changed_fraction(out.frames[i].image, recording.frames[i].image);
}

TEST(FaultOverlay, CoversItsPartOfTheImage) {
  const Recording recording = small_recording();
  EXPECT_NEAR(fraction(recording, "overlay_blocks_5"), 0.05, 0.01);
  EXPECT_NEAR(fraction(recording, "overlay_blocks_15"), 0.15, 0.015);
  EXPECT_NEAR(fraction(recording, "overlay_blocks_25"), 0.25, 0.02);
  EXPECT_NEAR(fraction(recording, "overlay_blocks_33"), 0.33, 0.02);
  EXPECT_NEAR(fraction(recording, "overlay_logo"), 0.09, 0.03);
  EXPECT_NEAR(fraction(recording, "overlay_bonnet"), 0.22, 0.05);
  EXPECT_NEAR(fraction(recording, "covered"), 0.66, 0.03);
  EXPECT_GT(fraction(recording, "overlay_dirt"), 0.1);
  EXPECT_GT(fraction(recording, "overlay_time_text"), 0.01);
}

TEST(FaultOverlay, IsTheSameInEveryImageOfBothCameras) {
  const Recording recording = small_recording();
  const Recording out = faulty(recording, "overlay_blocks_33");
  Image mask;
  cv::bitwise_and(out.frames[0].image != recording.frames[0].image,
                  out.frames[0].right != recording.frames[0].right, mask);
  Image difference;
  cv::absdiff(out.frames[0].image, out.frames[40].right, difference);
  EXPECT_EQ(cv::norm(difference, cv::NORM_INF,
                     mask & (out.frames[40].right != recording.frames[40].right)),
            0);
}

TEST(FaultOverlay, TimeTextChangesWithTheFrame) {
  const Recording recording = small_recording();
  Recording still = recording;
  for (Frame& frame : still.frames) frame.image = recording.frames[0].image;
  const Recording out = faulty(still, "overlay_time_text");
  EXPECT_FALSE(equal(out.frames[0].image, out.frames[1].image));
}

}  // namespace overlay_test
}  // namespace placegraph::faults::test
