#include "apps/support/progress.h"

#include <gtest/gtest.h>

namespace placegraph::apps {
namespace progress_test {

Pace::Clock::time_point at(double seconds) {
  return Pace::Clock::time_point(
      std::chrono::duration_cast<Pace::Clock::duration>(std::chrono::duration<double>(seconds)));
}

TEST(Pace, CountsFromTheFirstCount) {
  Pace pace;
  EXPECT_FALSE(pace.rate());
  pace.update(100, at(5));  // of a run that goes on
  EXPECT_FALSE(pace.rate());
  pace.update(104, at(7));
  EXPECT_DOUBLE_EQ(*pace.rate(), 2);
}

TEST(Pace, BeginsAgainWhereTheCountDoes) {
  Pace pace;
  for (int frame = 1; frame <= 180; ++frame) pace.update(frame, at(frame));  // one a second
  pace.update(1, at(181));
  EXPECT_FALSE(pace.rate());
  pace.update(41, at(191));
  EXPECT_DOUBLE_EQ(*pace.rate(), 4);
}

TEST(ProgressText, TellsTheTimeLeftByTheRate) {
  EXPECT_EQ(progress_text(42, 282, 4.0, "frames"), "42/282 frames, 4.0/s, 1:00 left");
  EXPECT_EQ(progress_text(1, 282, std::nullopt, "frames"), "1/282 frames");
}

}  // namespace progress_test
}  // namespace placegraph::apps
