#include <gtest/gtest.h>
#include <placegraph/eval/drawing/plot_axis.h>

#include <algorithm>
#include <cmath>

#include "tests/support/seed.h"

namespace placegraph {
namespace plot_axis_test {

TEST(PlotAxis, AStepIsTheLeastRoundNumberThatFillsTheSizeInSoManySteps) {
  Random random = test::seeded_random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const double size = std::pow(10, random.uniform(-8, 8));
    const int count = 1 + random.index(20);
    const double step = nice_step(size, count);
    const double power = std::pow(10, std::floor(std::log10(step) + 1e-9));
    const double digit = step / power, rounded = std::round(digit);
    EXPECT_NEAR(digit, rounded, 1e-9);
    EXPECT_TRUE(rounded == 1 || rounded == 2 || rounded == 5) << digit;
    const double smaller = power * (rounded == 1 ? 0.5 : rounded == 2 ? 1 : 2);
    EXPECT_GE(step * count, size * (1 - 1e-9));
    EXPECT_LT(smaller * count, size * (1 + 1e-9));
  }
}

TEST(PlotAxis, TicksFillTheIntervalEvenlyAndTheirTextsSayWhereTheyAre) {
  Random random = test::seeded_random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const double size = std::pow(10, random.uniform(-6, 6));
    const double middle = random.normal() * std::pow(10, random.uniform(-2, 7));
    if (size < 1e-7 * std::abs(middle)) continue;  // no digits are left of the differences
    const Interval interval = resized({middle, middle}, size);
    const int count = 2 + random.index(9);
    const AxisTicks ticks = linear_ticks(interval, count);
    const double step = nice_step(interval.size(), count), rounding = 1e-6 * size;
    ASSERT_FALSE(ticks.ticks.empty() && step < size / 2);
    EXPECT_LE(ticks.ticks.size(), static_cast<std::size_t>(count) + 1);
    for (std::size_t i = 0; i < ticks.ticks.size(); ++i) {
      const AxisTick& tick = ticks.ticks[i];
      EXPECT_GE(tick.at, interval.min - rounding);
      EXPECT_LE(tick.at, interval.max + rounding);
      EXPECT_NEAR(std::stod(tick.text) + ticks.offset, tick.at, rounding) << tick.text;
      EXPECT_FALSE(tick.text.starts_with('-') && std::stod(tick.text) == 0) << tick.text;
      if (i > 0) {
        EXPECT_NEAR(tick.at - ticks.ticks[i - 1].at, step, rounding);
      }
    }
    if (ticks.ticks.empty()) continue;
    EXPECT_LT(ticks.ticks.front().at - interval.min, step + rounding);
    EXPECT_LT(interval.max - ticks.ticks.back().at, step + rounding);
  }
}

TEST(PlotAxis, AMarginKeepsTheMiddleAndHoldsTheData) {
  Random random = test::seeded_random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Interval data;
    for (int i = 1 + random.index(5); i > 0; --i) data.add(random.normal(5, 20));
    data.add(NAN);
    data.add(-INFINITY);
    ASSERT_TRUE(std::isfinite(data.size()));
    const double margin = random.uniform(0, 0.2), least = random.uniform(0.1, 3);
    const Interval shown = with_margin(data, margin, least);
    EXPECT_NEAR(shown.middle(), data.middle(), 1e-12 * (1 + std::abs(data.middle())));
    EXPECT_NEAR(shown.size(), std::max(least, (1 + 2 * margin) * data.size()), 1e-9);
  }
}

TEST(PlotAxis, LogarithmicTicksAreNamedByTheirPower) {
  for (const double px_per_decade : {50.0, 400.0}) {
    const AxisTicks ticks = log_ticks({-2.5, 3.1}, px_per_decade, 46);
    EXPECT_EQ(ticks.ticks.size(), 17u);  // 0.005, 0.01, 0.02 ... 1000
    for (const AxisTick& tick : ticks.ticks) {
      const bool ten = std::abs(tick.at - std::round(tick.at)) < 1e-9;
      EXPECT_EQ(tick.text.empty(), px_per_decade == 50 && !ten) << tick.at;
      if (!tick.text.empty()) {
        EXPECT_NEAR(std::log10(std::stod(tick.text)), tick.at, 1e-9);
      }
    }
  }
}

TEST(PlotAxis, ComparableNumbersHaveThreeDigitsOfTheSmallestAndEqualDecimals) {
  Random random = test::seeded_random(4);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> values;
    for (int i = 1 + random.index(4); i > 0; --i)
      values.push_back(std::pow(10, random.uniform(-2, 3)));
    const std::vector<std::string> texts = comparable(values);
    ASSERT_EQ(texts.size(), values.size());
    const auto decimals = [](const std::string& text) {
      const std::size_t point = text.find('.');
      return point == std::string::npos ? 0 : text.size() - point - 1;
    };
    const double smallest = *std::ranges::min_element(values);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_EQ(decimals(texts[i]), decimals(texts[0]));
      EXPECT_LE(decimals(texts[i]), 4u);
      EXPECT_NEAR(std::stod(texts[i]), values[i], 0.00501 * smallest);  // half of the third digit
    }
  }
}

}  // namespace plot_axis_test
}  // namespace placegraph
