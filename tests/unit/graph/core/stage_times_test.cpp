#include <gtest/gtest.h>
#include <placegraph/graph/core/stage_times.h>

namespace placegraph {
namespace {

/// Work that takes CPU time; a clock that does not move would make the tests below say nothing.
void work() {
  volatile double sum = 0;
  for (int i = 0; i < 300000; ++i) sum = sum + 1.0 / (i + 1);
}

double cpu_s(const StageTimes& times, const std::string& name) {
  for (const StageTimes::Stage& stage : times.stages())
    if (stage.name == name) return stage.cpu_s;
  return -1;
}

TEST(StageTimes, CountsCallsAndAddsUpTime) {
  StageTimes times;
  for (int i = 0; i < 3; ++i) {
    const auto span = times.measure("a");
    work();
  }
  ASSERT_EQ(times.stages().size(), 1u);
  EXPECT_EQ(times.stages()[0].name, "a");
  EXPECT_EQ(times.stages()[0].calls, 3);
  EXPECT_GT(times.stages()[0].cpu_s, 0);
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

}  // namespace
}  // namespace placegraph
