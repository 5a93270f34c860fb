#include <gtest/gtest.h>
#include <placegraph/graph/core/stage_times.h>
#include <time.h>

namespace placegraph {
namespace stage_times_test {

/// Work that takes CPU time; a clock that does not move would make the tests below say nothing.
void work() {
  volatile double sum = 0;
  for (int i = 0; i < 300000; ++i) sum = sum + 1.0 / (i + 1);
}

/// The CPU time of this process so far, as the stages count it; in nanoseconds of the clock.
double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr double kRounding_s = 1e-9;  // sums of doubles, far below a step of the clock

double cpu_s(const StageTimes& times, const std::string& name) {
  for (const StageTime& stage : times.stages())
    if (stage.name == name) return stage.cpu_s;
  return -1;
}

TEST(StageTimes, CountsCallsAndAddsUpTime) {
  StageTimes times;
  double inside_s = 0;
  const double before_s = process_cpu_s();
  for (int i = 0; i < 3; ++i) {
    const auto span = times.measure("a");
    const double begin_s = process_cpu_s();
    work();
    inside_s += process_cpu_s() - begin_s;
  }
  const double around_s = process_cpu_s() - before_s;
  ASSERT_EQ(times.stages().size(), 1u);
  EXPECT_EQ(times.stages()[0].name, "a");
  EXPECT_EQ(times.stages()[0].calls, 3);
  EXPECT_GE(times.stages()[0].cpu_s, inside_s - kRounding_s);
  EXPECT_LE(times.stages()[0].cpu_s, around_s + kRounding_s);
}

TEST(StageTimes, StagesThatCallEachOtherShareTheTimeAndCountNoneOfItTwice) {
  StageTimes times;
  double inside_s = 0;
  const double before_s = process_cpu_s();
  for (int i = 0; i < 3; ++i) {
    const auto outer = times.measure("outer");
    const double begin_s = process_cpu_s();
    work();
    {
      const auto middle = times.measure("middle");
      work();
      const auto inner = times.measure("inner");
      work();
    }
    work();
    inside_s += process_cpu_s() - begin_s;
  }
  const double around_s = process_cpu_s() - before_s;
  const double sum_s = cpu_s(times, "outer") + cpu_s(times, "middle") + cpu_s(times, "inner");
  EXPECT_GE(sum_s, inside_s - kRounding_s);
  EXPECT_LE(sum_s, around_s + kRounding_s);
}

TEST(StageTimes, AStageDoesNotCountWhatItCalledOthersFor) {
  StageTimes times;
  {
    const auto outer = times.measure("outer");
    for (int i = 0; i < 20; ++i) {
      const auto inner = times.measure("inner");
      work();
    }
  }
  // The outer one did nothing itself; twenty times as much is the other's.
  EXPECT_LT(cpu_s(times, "outer"), 0.5 * cpu_s(times, "inner"));
  EXPECT_GE(cpu_s(times, "outer"), 0);
}

TEST(StageTimes, AStageMetAgainDeeperInsideIsOneStage) {
  StageTimes times;
  {
    const auto a = times.measure("a");
    const auto b = times.measure("b");
    const auto again = times.measure("a");
  }
  ASSERT_EQ(times.stages().size(), 2u);
  EXPECT_EQ(times.stages()[0].calls, 2);
  EXPECT_EQ(times.stages()[1].calls, 1);
}

}  // namespace stage_times_test
}  // namespace placegraph
