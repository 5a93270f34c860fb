#include <gtest/gtest.h>
#include <placegraph/eval/association/stamp_shift.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace stamp_shift_test {

using Stamps = std::vector<std::int64_t>;

/// A recording from `begin_s` at a rate, with jitter, of which a share of the stamps is missing.
struct Clock {
  double begin_s = 100, duration_s = 30, rate_hz = 10, jitter_s = 0, missing = 0;
};

Stamps stamps_of(const Clock& clock, Random& random) {
  Stamps stamps;
  const int n = static_cast<int>(std::lround(clock.duration_s * clock.rate_hz));
  for (int i = 0; i < n; ++i) {
    const double jitter_s = random.normal(0, clock.jitter_s);
    if (random.uniform() < clock.missing) continue;
    const double at_s = clock.begin_s + i / clock.rate_hz + jitter_s;
    stamps.push_back(std::llround(at_s * 1e9));
  }
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

Stamps plus(Stamps stamps, double shift_s) {
  for (std::int64_t& stamp : stamps) stamp += std::llround(shift_s * 1e9);
  return stamps;
}

TEST(StampShift, FindsTheConstantOfTwoRegularClocks) {
  Random random(1);
  const Stamps truth = stamps_of({}, random);
  const auto found = constant_shift_that_pairs(truth, plus(truth, -0.03), 0.02);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->shift_s, 0.03);
  EXPECT_EQ(found->pairs, 300);
  EXPECT_EQ(found->pairs_now, 0);
  EXPECT_EQ(found->stamps, 300);
}

TEST(StampShift, TakesTheNearestToZeroOfConstantsThatRegularClocksCannotTell) {
  Random random(2);
  for (const double late_s : {0.03, 0.07, 1.03, 2.96}) {
    // In the middle of the truth, every constant of 0.1 s more pairs as many.
    const Stamps truth = stamps_of({100, 60, 10}, random);
    const Stamps estimate = stamps_of({120 + late_s, 10, 10}, random);
    const auto found = constant_shift_that_pairs(truth, estimate, 0.02);
    ASSERT_TRUE(found) << late_s;
    EXPECT_NEAR(found->shift_s, -std::remainder(late_s, 0.1), 1e-9) << late_s;
    EXPECT_EQ(found->pairs, 100);
  }
}

TEST(StampShift, HoldsForRatesPhasesJitterAndDropOuts) {
  int judged = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const double rate_hz = random.uniform(5, 20), shift_s = random.uniform(-0.5, 0.5) / rate_hz;
    const double limit_s = 0.1 / rate_hz, jitter_s = 0.02 / rate_hz;
    // The truth has one to three stamps for one of the estimate, and each side lacks some.
    const double truth_hz = rate_hz * (1 + random.index(3));
    const Stamps truth = stamps_of({100, 40, truth_hz, 0, random.uniform(0, 0.1)}, random);
    const Stamps estimate = stamps_of(
        {100 + 100 / rate_hz - shift_s, 20, rate_hz, jitter_s, random.uniform(0, 0.1)}, random);
    if (std::abs(std::remainder(shift_s, 1 / truth_hz)) < limit_s + 3 * jitter_s) continue;
    ++judged;
    const auto found = constant_shift_that_pairs(truth, estimate, limit_s);
    ASSERT_TRUE(found) << "seed " << seed;
    // The median of 90 stamps or more is good to a seventh of their deviation (1.25 / sqrt(90)):
    // three of it, and the rounding to at most a tenth of the limit.
    const double off_s = std::remainder(found->shift_s - shift_s, 1 / truth_hz);
    EXPECT_LT(std::abs(off_s), 0.4 * jitter_s + 0.05 * limit_s) << "seed " << seed;
    // The nearest to zero, or the next if what each side lacks happens to favour it.
    EXPECT_LT(std::abs(found->shift_s), 1 / truth_hz) << "seed " << seed;
    EXPECT_GE(found->pairs, 0.8 * found->stamps) << "seed " << seed;
  }
  EXPECT_GT(judged, 50);
}

TEST(StampShift, DropOutsOfBothTellConstantsApartThatSpacingsCannot) {
  Random random(3);
  const Stamps truth = stamps_of({100, 60, 10, 0, 0.1}, random);
  const auto found = constant_shift_that_pairs(truth, plus(truth, 1.23), 0.02);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->shift_s, -1.23);
  EXPECT_EQ(found->pairs, static_cast<int>(truth.size()));
}

TEST(StampShift, ASwapOfTheTwoChangesTheSignAlone) {
  for (int seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const Stamps a = stamps_of({100, 30, 10, 0, 0.1}, random);
    const Stamps b = stamps_of({100.033, 30, 20, 1e-3, 0.1}, random);
    const auto forth = constant_shift_that_pairs(a, b, 0.005);
    const auto back = constant_shift_that_pairs(b, a, 0.005);
    ASSERT_EQ(forth.has_value(), back.has_value()) << "seed " << seed;
    if (!forth) continue;
    EXPECT_NEAR(forth->shift_s, -back->shift_s, 2e-4) << "seed " << seed;  // a unit of rounding
    EXPECT_NEAR(forth->pairs, back->pairs, 2) << "seed " << seed;
  }
}

TEST(StampShift, SaysNothingOfStampsThatPairAsTheyAre) {
  Random random(4);
  const Stamps truth = stamps_of({}, random);
  EXPECT_FALSE(constant_shift_that_pairs(truth, truth, 0.02));
  EXPECT_FALSE(constant_shift_that_pairs(truth, plus(truth, 0.01), 0.02));
  // Any stamp is within 20 ms of one at 200 Hz.
  const Stamps dense = stamps_of({100, 30, 200}, random);
  EXPECT_FALSE(constant_shift_that_pairs(dense, plus(truth, 0.03), 0.02));
}

TEST(StampShift, SaysNothingWhereNoConstantIsClear) {
  int found = 0;
  for (int seed = 0; seed < 30; ++seed) {
    Random random(seed);
    const Stamps truth = stamps_of({100, 30, 12, 0, 0}, random);
    Stamps random_times;
    while (random_times.size() < 300)
      random_times.push_back(std::llround(random.uniform(100, 130) * 1e9));
    std::sort(random_times.begin(), random_times.end());
    found += constant_shift_that_pairs(truth, random_times, 0.02).has_value();
    // 10 and 12 Hz meet every half second alone.
    found +=
        constant_shift_that_pairs(truth, stamps_of({100.01, 30, 10}, random), 0.02).has_value();
    // A clock that is three thousandths fast runs through every phase in 30 s.
    found += constant_shift_that_pairs(truth, stamps_of({100, 30, 12 * 1.003}, random), 0.02)
                 .has_value();
  }
  EXPECT_EQ(found, 0);
}

TEST(StampShift, SaysNothingOfFewStampsOrOfOtherTimes) {
  Random random(5);
  const Stamps truth = stamps_of({}, random);
  EXPECT_FALSE(constant_shift_that_pairs(truth, {}, 0.02));
  EXPECT_FALSE(constant_shift_that_pairs(truth, {truth[10] + 30'000'000}, 0.02));
  EXPECT_FALSE(constant_shift_that_pairs(truth, plus(truth, 1e5), 0.02));
}

TEST(StampShift, EqualStampsMayBeAskedFor) {
  Random random(6);
  const Stamps truth = stamps_of({100, 30, 10, 1e-3}, random);
  const auto found = constant_shift_that_pairs(truth, plus(truth, -0.0123), 0);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->shift_s, 0.0123);
  EXPECT_EQ(found->pairs, 300);
}

TEST(StampShift, RefusesStampsThatDoNotIncreaseAndNegativeDifferences) {
  EXPECT_THROW((void)constant_shift_that_pairs({2, 1}, {1, 2}, 0.02), ArgumentError);
  EXPECT_THROW((void)constant_shift_that_pairs({1, 2}, {1, 1}, 0.02), ArgumentError);
  EXPECT_THROW((void)constant_shift_that_pairs({1, 2}, {1, 2}, -1), ArgumentError);
}

}  // namespace stamp_shift_test
}  // namespace placegraph
