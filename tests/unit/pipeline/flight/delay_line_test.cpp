#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/delay_line.h>

#include <cmath>

namespace placegraph {
namespace delay_line_test {

struct Reading {
  std::int64_t stamp_ns = 0;
  int value = 0;
};

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::vector<int> values(const std::vector<Reading>& readings) {
  std::vector<int> result;
  for (const Reading& reading : readings) result.push_back(reading.value);
  return result;
}

TEST(DelayLine, HoldsAMeasurementUntilItsDelayHasPassed) {
  DelayLine<Reading> line(0.25);
  line.push({kSecond_ns, 7});
  EXPECT_TRUE(line.take(kSecond_ns).empty());
  EXPECT_TRUE(line.take(kSecond_ns + kSecond_ns / 4 - 1000).empty());
  EXPECT_EQ(values(line.take(kSecond_ns + kSecond_ns / 4)), std::vector<int>{7});
  EXPECT_TRUE(line.take(3 * kSecond_ns).empty());
}

TEST(DelayLine, DeliversAllThatAreDueOldestFirstAndKeepsTheOthers) {
  DelayLine<Reading> line(1);
  for (int i = 0; i < 5; ++i) line.push({i * kSecond_ns, i});
  EXPECT_EQ(values(line.take(3 * kSecond_ns)), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(values(line.take(9 * kSecond_ns)), (std::vector<int>{3, 4}));
}

TEST(DelayLine, WithoutADelayDeliversAtOnce) {
  DelayLine<Reading> line(0);
  line.push({kSecond_ns, 1});
  line.push({kSecond_ns, 2});
  EXPECT_EQ(values(line.take(kSecond_ns)), (std::vector<int>{1, 2}));
}

TEST(DelayLine, DeliversNothingOfWhatWasCleared) {
  DelayLine<Reading> line(1);
  line.push({2 * kSecond_ns, 1});
  line.clear();
  line.push({kSecond_ns, 2});  // after a new start, older ones may come
  EXPECT_EQ(values(line.take(9 * kSecond_ns)), std::vector<int>{2});
}

TEST(DelayLine, RefusesMeasurementsOutOfOrderAndNegativeDelays) {
  DelayLine<Reading> line(1);
  line.push({2 * kSecond_ns, 1});
  EXPECT_THROW(line.push({kSecond_ns, 2}), ArgumentError);
  EXPECT_THROW(DelayLine<Reading>(-0.1), ArgumentError);
  EXPECT_THROW(DelayLine<Reading>(std::nan("")), ArgumentError);
}

}  // namespace delay_line_test
}  // namespace placegraph
