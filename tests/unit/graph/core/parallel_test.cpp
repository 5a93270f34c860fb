#include <gtest/gtest.h>
#include <placegraph/graph/core/parallel.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace placegraph {
namespace parallel_test {

/// Longer than the time between two checks.
void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(120)); }

TEST(Interruption, WithoutAScopeNothingIsChecked) {
  wait();
  EXPECT_NO_THROW(check_interruption());
}

TEST(Interruption, TheCheckOfTheScopeEndsTheCall) {
  const InterruptionScope scope([] { throw std::runtime_error("enough"); });
  wait();
  EXPECT_THROW(check_interruption(), std::runtime_error);
}

TEST(Interruption, ChecksAreRare) {
  int checks = 0;
  const InterruptionScope scope([&] { ++checks; });
  wait();
  for (int i = 0; i < 1000; ++i) check_interruption();
  EXPECT_GE(checks, 1);
  EXPECT_LT(checks, 10);
}

TEST(Interruption, AnInnerScopeTakesThePlaceOfTheOuterOneWhileItExists) {
  int outer = 0, inner = 0;
  const InterruptionScope scope([&] { ++outer; });
  {
    const InterruptionScope within([&] { ++inner; });
    wait();
    check_interruption();
  }
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 0);
  check_interruption();
  EXPECT_EQ(outer, 1);
}

TEST(Interruption, OtherThreadsAreNotAsked) {
  int checks = 0;
  const InterruptionScope scope([&] { ++checks; });
  wait();
  std::thread([] { check_interruption(); }).join();
  EXPECT_EQ(checks, 0);
}

TEST(Interruption, EndsAParallelCallAndItsThreads) {
  const InterruptionScope scope([] { throw std::runtime_error("enough"); });
  for (const int threads : {1, 3})
    EXPECT_THROW(parallel_for(1000, threads, [](int) { wait(); }), std::runtime_error);
}

}  // namespace parallel_test
}  // namespace placegraph
