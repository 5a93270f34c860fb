#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace scene_test {

TEST(FaultScene, MovingObjectFillsAThirdOfTheImageAndIsNearInDepth) {
  const Recording recording = small_recording(), out = faulty(recording, "moving_object");
  const std::size_t middle = (out.faulty.first + out.faulty.last) / 2;
  EXPECT_NEAR(changed_fraction(out.frames[middle].image, recording.frames[middle].image), 0.33,
              0.03);
  const Image near = out.frames[middle].depth == 1.0F;
  EXPECT_NEAR(cv::countNonZero(near) / (64.0 * 96), 0.33, 0.03);
  EXPECT_TRUE(
      equal(out.frames[out.faulty.last + 1].image, recording.frames[out.faulty.last + 1].image));
  EXPECT_FALSE(equal(out.frames[middle].right, recording.frames[middle].right));
}

TEST(FaultScene, PlainWallHasNoTextureFor20Frames) {
  const Recording recording = small_recording(), out = faulty(recording, "plain_wall");
  int plain = 0;
  for (const Frame& frame : out.frames) plain += contrast_of(frame.image) < 3;
  EXPECT_EQ(plain, 20);
  EXPECT_EQ(contrast_of(out.frames[30].depth), 0);
}

TEST(FaultScene, MirrorsAndRepeatsForAWhile) {
  const Recording recording = small_recording();
  const Recording mirrored = faulty(recording, "mirrored_while");
  Image back;
  cv::flip(mirrored.frames[35].image, back, 1);
  EXPECT_TRUE(equal(back, recording.frames[35].image));
  EXPECT_TRUE(equal(mirrored.frames[50].image, recording.frames[50].image));
  const Image repeated = faulty(recording, "half_repeated").frames[30].image;
  EXPECT_TRUE(equal(repeated.colRange(0, 48), repeated.colRange(48, 96)));
}

TEST(FaultScene, SnowAndFlareBrighten) {
  const Recording recording = small_recording();
  const Recording snow = faulty(recording, "snow");
  EXPECT_GT(changed_fraction(snow.frames[0].image, recording.frames[0].image), 0.01);
  EXPECT_LT(changed_fraction(snow.frames[0].image, recording.frames[0].image), 0.15);
  EXPECT_GT(mean_of(faulty(recording, "flare").frames[0].image),
            mean_of(recording.frames[0].image) + 5);
}

}  // namespace scene_test
}  // namespace placegraph::faults::test
