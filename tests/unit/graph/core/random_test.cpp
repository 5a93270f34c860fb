#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <tests/support/seed.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

namespace placegraph {
namespace random_test {

TEST(Random, GivesTheReferenceSequenceOfPcg32) {
  // The demo of the PCG reference implementation: seed 42, stream 54.
  Random random(42, 54);
  for (const std::uint32_t expected :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, SameSeedGivesTheSameNumbersOfEveryKind) {
  Random a(5, 1), b(5, 1);
  std::vector<int> sample_a, sample_b;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(a.index(17), b.index(17));
    EXPECT_EQ(a.uniform(-2, 3), b.uniform(-2, 3));
    EXPECT_EQ(a.normal(1, 2), b.normal(1, 2));
    a.sample(20, 4, sample_a);
    b.sample(20, 4, sample_b);
    EXPECT_EQ(sample_a, sample_b);
  }
}

TEST(Random, SeedsAndStreamsDiffer) {
  Random a(5, 1), other_seed(6, 1), other_stream(5, 2);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t value = a.next();
    equal += value == other_seed.next();
    equal += value == other_stream.next();
  }
  EXPECT_LE(equal, 1);  // 200 chances of 2^-32
}

// A step that draws the numbers of another would repeat its choices.
TEST(Random, EveryStepOfEveryItemHasNumbersOfItsOwn) {
  const auto numbers_of = [](Random random) { return std::array{random.next(), random.next()}; };
  Random seeds = test::seeded_random(4);
  const std::uint64_t seed = seeds.next();
  std::set<std::array<std::uint32_t, 2>> seen;
  std::size_t streams = 0;
  for (const std::string_view step : {"", "a", "b", "ab", "ba", "pose from points", "rotation"})
    for (std::int64_t frame = 0; frame < 500; ++frame) {
      seen.insert(numbers_of(Random(seed, step, {frame})));
      seen.insert(numbers_of(Random(seed, step, {frame, 0})));
      seen.insert(numbers_of(Random(seed, step, {-1, frame})));
      streams += 3;
      ASSERT_EQ(seen.size(), streams) << step << " " << frame;
    }
  EXPECT_EQ(numbers_of(Random(seed, "a", {3, 4})), numbers_of(Random(seed, "a", {3, 4})));
  EXPECT_NE(numbers_of(Random(seed, "a", {3, 4})), numbers_of(Random(seed, "a", {4, 3})));
  EXPECT_NE(numbers_of(Random(seed, "a", {3})), numbers_of(Random(seed + 1, "a", {3})));
}

TEST(Random, IndicesAreUniform) {
  Random random = test::seeded_random(1);
  constexpr int kBins = 7, kDraws = 70000;
  std::vector<int> count(kBins);
  for (int i = 0; i < kDraws; ++i) ++count.at(random.index(kBins));
  // Binomial sigma = sqrt(70000 * 1/7 * 6/7) = 93: five of them.
  for (const int c : count) EXPECT_NEAR(c, kDraws / kBins, 465);
}

TEST(Random, IndexOfOneIsZeroAndOfNoneIsRefused) {
  Random random(1);
  EXPECT_EQ(random.index(1), 0);
  EXPECT_THROW(random.index(0), ArgumentError);
  EXPECT_THROW(random.index(-4), ArgumentError);
}

TEST(Random, UniformStaysInsideAndHasItsMoments) {
  Random random = test::seeded_random(2);
  constexpr int kDraws = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform(-1, 3);
    ASSERT_GE(value, -1);
    ASSERT_LT(value, 3);
    sum += value - 1;
    squares += (value - 1) * (value - 1);
  }
  // Variance 16 / 12; sigma of the mean 1.155 / sqrt(n) = 0.0037, of the square 1.19 / sqrt(n).
  EXPECT_NEAR(sum / kDraws, 0, 5 * 0.0037);
  EXPECT_NEAR(squares / kDraws, 4. / 3, 5 * 0.0038);
}

TEST(Random, NormalHasItsMomentsAndTails) {
  Random random = test::seeded_random(3);
  constexpr int kDraws = 100000;
  double sum = 0, squares = 0, fourth = 0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = (random.normal(5, 2) - 5) / 2;
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    beyond_two += std::abs(x) > 2;
  }
  // Sigmas: 1, sqrt(2), sqrt(96) and sqrt(p (1 - p)), p = 0.0455, over sqrt(n) = 316.
  EXPECT_NEAR(sum / kDraws, 0, 5 * 1 / 316.);
  EXPECT_NEAR(squares / kDraws, 1, 5 * 1.414 / 316.);
  EXPECT_NEAR(fourth / kDraws, 3, 5 * 9.8 / 316.);
  EXPECT_NEAR(beyond_two / double(kDraws), 0.0455, 5 * 0.2084 / 316.);
}

TEST(Random, SampleHoldsDifferentIndicesOfTheRange) {
  Random random = test::seeded_random(4);
  std::vector<int> sample = {99, 99};
  for (const auto& [n, k] : {std::pair(1, 1), {5, 5}, {100, 8}, {100, 33}, {40, 40}, {1000, 64}}) {
    random.sample(n, k, sample);
    EXPECT_EQ(static_cast<int>(sample.size()), k);
    EXPECT_EQ(static_cast<int>(std::set<int>(sample.begin(), sample.end()).size()), k);
    EXPECT_GE(*std::min_element(sample.begin(), sample.end()), 0);
    EXPECT_LT(*std::max_element(sample.begin(), sample.end()), n);
  }
  random.sample(3, 0, sample);
  EXPECT_TRUE(sample.empty());
}

TEST(Random, SampleTakesEveryIndexEquallyOften) {
  Random random = test::seeded_random(5);
  std::vector<int> sample, count(10);
  for (int i = 0; i < 20000; ++i) {
    random.sample(10, 3, sample);
    for (const int index : sample) ++count[index];
  }
  // Binomial: n = 20000, p = 0.3: sigma 65.
  for (const int c : count) EXPECT_NEAR(c, 6000, 5 * 65);
}

TEST(Random, SampleOfMoreThanThereAreIsRefused) {
  Random random(1);
  std::vector<int> sample;
  EXPECT_THROW(random.sample(3, 4, sample), ArgumentError);
  EXPECT_THROW(random.sample(3, -1, sample), ArgumentError);
}

}  // namespace random_test
}  // namespace placegraph
