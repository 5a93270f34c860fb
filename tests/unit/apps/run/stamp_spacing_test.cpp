#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/run/stamp_spacing.h"

namespace placegraph::apps {
namespace stamp_spacing_test {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

TEST(StampSpacing, CountsWhatIsMissingInGaps) {
  // 10 Hz; two frames are missing after the third, one after the fourth.
  const StampSpacing spacing = stamp_spacing(
      {0, 100 * kMs, 200 * kMs, 500 * kMs, 700 * kMs, 800 * kMs, 900 * kMs, 1000 * kMs});
  EXPECT_DOUBLE_EQ(spacing.median_s, 0.1);
  EXPECT_DOUBLE_EQ(spacing.least_s, 0.1);
  EXPECT_DOUBLE_EQ(spacing.greatest_s, 0.3);
  EXPECT_EQ(spacing.missing, 3u);
  EXPECT_THAT(spacing.gaps, ElementsAre(testing::Field(&StampGap::after, 2u),
                                        testing::Field(&StampGap::after, 3u)));
}

TEST(StampSpacing, TakesJitterForNoGap) {
  const StampSpacing spacing = stamp_spacing({0, 33 * kMs, 80 * kMs, 100 * kMs, 134 * kMs});
  EXPECT_THAT(spacing.gaps, IsEmpty());
  EXPECT_EQ(spacing.missing, 0u);
}

TEST(StampSpacing, OfOneStampIsZero) {
  const StampSpacing spacing = stamp_spacing({7});
  EXPECT_EQ(spacing.median_s, 0);
  EXPECT_THAT(spacing.gaps, IsEmpty());
}

}  // namespace stamp_spacing_test
}  // namespace placegraph::apps
