#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>

namespace placegraph {
namespace stamp_plausibility_test {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::int64_t> stamps(std::int64_t first_ns, std::int64_t step_ns, int count = 20) {
  std::vector<std::int64_t> result;
  for (int i = 0; i < count; ++i) result.push_back(first_ns + i * step_ns);
  return result;
}

TEST(OddSpacing, IsThatOfAnotherUnit) {
  EXPECT_EQ(odd_spacing(stamps(0, 100'000'000'000), "frame"),
            "a frame every 100 s (0.01 Hz): are these milliseconds?");
  EXPECT_THAT(odd_spacing(stamps(0, 100'000'000'000'000), "frame"), HasSubstr("microseconds?"));
  EXPECT_THAT(odd_spacing(stamps(0, 100'000'000'000'000'000, 5), "frame"),
              HasSubstr("nanoseconds?"));
  // Microseconds that were read as nanoseconds.
  EXPECT_THAT(odd_spacing(stamps(0, 100'000), "pose"), HasSubstr("1000 times too small?"));
}

TEST(IrregularSpacing, NamesGaps) {
  std::vector<std::int64_t> times = stamps(0, 100'000'000);
  EXPECT_THAT(irregular_spacing(times), IsEmpty());
  for (std::size_t i = 10; i < times.size(); ++i) times[i] += 200'000'000;  // two images dropped
  EXPECT_THAT(irregular_spacing(times), IsEmpty());
  for (std::size_t i = 15; i < times.size(); ++i) times[i] += 900'000'000;
  EXPECT_EQ(irregular_spacing(times),
            "1 intervals between images are over five times the median of 0.1 s, up to 1 s, the "
            "first after frame 14: images are missing, or times jump");
}

TEST(IrregularSpacing, NamesTimesThatVary) {
  std::vector<std::int64_t> times = stamps(0, 100'000'000);
  for (std::size_t i = 0; i < times.size(); i += 2) times[i] += 5'000'000;
  EXPECT_THAT(irregular_spacing(times), IsEmpty());
  for (std::size_t i = 0; i < times.size(); i += 4) times[i] += 40'000'000;
  EXPECT_THAT(irregular_spacing(times), HasSubstr("irregular: 9 of 19"));
  EXPECT_THAT(irregular_spacing({}), IsEmpty());
  EXPECT_THAT(irregular_spacing({1, 2}), IsEmpty());
}

TEST(OddSpacing, IsNotThatOfSlowOrFastSensors) {
  EXPECT_THAT(odd_spacing(stamps(0, 2'000'000'000), "frame"), IsEmpty());
  EXPECT_THAT(odd_spacing(stamps(0, 1'000'000), "pose"), IsEmpty());
  EXPECT_THAT(odd_spacing({5}, "frame"), IsEmpty());
}

TEST(OtherClock, NamesFactorOrOffset) {
  const auto truth = stamps(1'600'000'000'000'000'000, 100'000'000);
  EXPECT_THAT(
      other_clock(stamps(0, 100'000'000), stamps(0, 100'000'000'000), "the odometry"),
      HasSubstr("the odometry seems to have its times in milliseconds: times 0.001 it fits"));
  EXPECT_THAT(other_clock(truth, stamps(0, 100'000'000), "the estimate"),
              HasSubstr("of another clock, -1600000000.000 s later"));
  EXPECT_THAT(other_clock(truth, stamps(0, 7'000'000, 4), "the estimate"), IsEmpty());
}

}  // namespace stamp_plausibility_test
}  // namespace placegraph
