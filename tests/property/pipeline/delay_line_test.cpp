#include <gtest/gtest.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/pipeline/flight/delay_line.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace delay_line_test {

struct Numbered {
  std::int64_t stamp_ns = 0;
  int number = 0;
};

/// Whatever is pushed comes out once, in its order, not before its delay has passed and not after
/// the first call from then on.
TEST(DelayLineLaw, DeliversAllInOrderAsSoonAsTheirDelayHasPassed) {
  Random random = test::seeded_random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const double delay_s = trial == 0 ? 0 : random.uniform(0, 0.5);
    DelayLine<Numbered> line(delay_s);
    std::vector<std::int64_t> stamps;
    std::int64_t now_ns = 0, last_take_ns = -1;
    int delivered = 0;
    for (int step = 0; step < 200; ++step) {
      now_ns += static_cast<std::int64_t>(1e8 * random.uniform());
      if (random.uniform() < 0.6) {
        line.push({now_ns, static_cast<int>(stamps.size())});
        stamps.push_back(now_ns);
      }
      if (random.uniform() < 0.5) continue;
      for (const Numbered& measurement : line.take(now_ns)) {
        EXPECT_EQ(measurement.number, delivered++);
        EXPECT_GE(seconds(measurement.stamp_ns, now_ns), delay_s);
        EXPECT_TRUE(measurement.stamp_ns > last_take_ns ||
                    seconds(measurement.stamp_ns, last_take_ns) < delay_s);
      }
      last_take_ns = now_ns;
    }
    delivered += static_cast<int>(line.take(now_ns + 1'000'000'000).size());
    EXPECT_EQ(delivered, static_cast<int>(stamps.size()));
  }
}

}  // namespace delay_line_test
}  // namespace placegraph
