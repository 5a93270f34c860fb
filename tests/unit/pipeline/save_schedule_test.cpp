#include <gtest/gtest.h>
#include <placegraph/pipeline/save_schedule.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace save_schedule_test {

// Of runs of any length, with places after any number of frames.
TEST(SaveSchedule, WritesInProportionToTheRunAndLosesLittle) {
  Random random = test::seeded_random(1);
  for (int round = 0; round < 100; ++round) {
    const std::size_t frames = static_cast<std::size_t>(std::exp(random.uniform(2, 12)));
    const std::size_t most_between = static_cast<std::size_t>(1 + random.index(200));
    SaveSchedule schedule;
    std::size_t written = 0, saved = 0, place = 0;
    for (std::size_t i = 1; i <= frames; ++i) {
      if (i < place) continue;
      place = i + 1 + static_cast<std::size_t>(random.index(static_cast<int>(most_between)));
      if (schedule.due(i)) {
        schedule.saved(i);
        written += i;
        saved = i;
      }
      EXPECT_LE(i - saved, i / 500) << frames;
    }
    EXPECT_LE(written, 500 * frames);
  }
}

TEST(SaveSchedule, SavesEveryPlaceOfAShortRun) {
  SaveSchedule schedule;
  for (std::size_t i = 1; i <= 5000; i += 10) {
    EXPECT_TRUE(schedule.due(i)) << i;
    schedule.saved(i);
  }
}

}  // namespace save_schedule_test
}  // namespace placegraph
