#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace timing_test {

std::vector<int> sources(const Recording& recording, const Recording& out) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < out.size(); ++i) numbers.push_back(source_of(recording, out, i));
  return numbers;
}

TEST(FaultTiming, DroppedFramesKeepTheirStampsAndTruth) {
  const Recording recording = small_recording();
  for (const auto& [name, step] :
       {std::pair{"every_2nd", 2U}, {"every_3rd", 3U}, {"every_5th", 5U}}) {
    SCOPED_TRACE(name);
    const Recording out = faulty(recording, name);
    ASSERT_EQ(out.size(), 60 / step);
    EXPECT_EQ(source_of(recording, out, 4), static_cast<int>(4 * step));
    EXPECT_EQ(out.frames[4].stamp_ns, recording.frames[4 * step].stamp_ns);
    EXPECT_TRUE(out.T_world_cam[4].isApprox(recording.T_world_cam[4 * step]));
  }
  const Recording bursts = faulty(recording, "dropped_bursts");
  EXPECT_EQ(bursts.size(), 60U - 3 * 7);
  EXPECT_EQ(source_of(recording, bursts, 15), 22);
}

TEST(FaultTiming, OrdersAreWhatTheyAreCalled) {
  const Recording recording = small_recording();
  const std::vector<int> exchanged = sources(recording, faulty(recording, "neighbours_exchanged"));
  EXPECT_EQ(exchanged[0], 1);
  EXPECT_EQ(exchanged[1], 0);
  EXPECT_EQ(exchanged[59], 58);
  const std::vector<int> blocks = sources(recording, faulty(recording, "blocks_exchanged"));
  EXPECT_EQ(blocks[0], 10);
  EXPECT_EQ(blocks[10], 0);
  EXPECT_EQ(blocks[59], 49);
  std::vector<int> shuffled = sources(recording, faulty(recording, "shuffled"));
  EXPECT_FALSE(std::is_sorted(shuffled.begin(), shuffled.end()));
  std::sort(shuffled.begin(), shuffled.end());
  for (int i = 0; i < 60; ++i) EXPECT_EQ(shuffled[static_cast<std::size_t>(i)], i);
}

TEST(FaultTiming, OrdersKeepTheStampsIncreasing) {
  const Recording recording = small_recording();
  for (const char* name :
       {"neighbours_exchanged", "blocks_exchanged", "shuffled", "repeated_frames", "times_jittered",
        "times_milliseconds", "times_too_small", "times_gap"}) {
    SCOPED_TRACE(name);
    const Recording out = faulty(recording, name);
    for (std::size_t i = 1; i < out.size(); ++i)
      ASSERT_GT(out.frames[i].stamp_ns, out.frames[i - 1].stamp_ns) << i;
  }
}

TEST(FaultTiming, JitteredStampsVaryFromFrameToFrame) {
  const Recording out = faulty(small_recording(), "times_jittered");
  int varying = 0;
  for (std::size_t i = 2; i < out.size(); ++i) {
    const auto spacing = [&](std::size_t k) {
      return static_cast<double>(out.frames[k].stamp_ns - out.frames[k - 1].stamp_ns);
    };
    if (std::abs(spacing(i) / spacing(i - 1) - 1) > 0.1) ++varying;
  }
  EXPECT_GT(varying, 40);
}

TEST(FaultTiming, TruthOfARepeatedFrameStandsAndThatOfAFrozenOneMoves) {
  const Recording recording = small_recording();
  const Recording repeated = faulty(recording, "repeated_frames");
  ASSERT_EQ(repeated.size(), 120U);
  EXPECT_EQ(source_of(recording, repeated, 21), 10);
  EXPECT_TRUE(repeated.T_world_cam[21].isApprox(recording.T_world_cam[10]));
  const Recording frozen = faulty(recording, "frozen");
  EXPECT_EQ(source_of(recording, frozen, frozen.faulty.last),
            static_cast<int>(frozen.faulty.first));
  EXPECT_TRUE(
      frozen.T_world_cam[frozen.faulty.last].isApprox(recording.T_world_cam[frozen.faulty.last]));
  EXPECT_EQ(frozen.frames[35].stamp_ns, recording.frames[35].stamp_ns);
}

TEST(FaultTiming, StampsAreWrongAsTheyAreCalled) {
  const Recording recording = small_recording();
  const auto stamp = [&](const char* name, std::size_t i) {
    return faulty(recording, name).frames[i].stamp_ns;
  };
  const std::int64_t at_8 = recording.frames[8].stamp_ns;
  EXPECT_EQ(stamp("times_half_rate", 8), 2 * at_8);
  EXPECT_EQ(stamp("times_milliseconds", 8), 1000 * at_8);
  EXPECT_EQ(stamp("times_too_small", 8), at_8 / 1000);
  EXPECT_EQ(stamp("times_equal", 9), at_8);
  EXPECT_EQ(stamp("times_gap", 8), at_8);
  EXPECT_EQ(stamp("times_gap", 40), recording.frames[40].stamp_ns + 3600000000000);
  EXPECT_NE(stamp("times_jittered", 8) - stamp("times_jittered", 7), 100000000);
}

}  // namespace timing_test
}  // namespace placegraph::faults::test
