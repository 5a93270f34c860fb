#include "apps/server/plugin/bounded_tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <barrier>
#include <latch>
#include <numeric>

#include "tests/support/sleeping_thread.h"

namespace placegraph::apps {
namespace bounded_tasks_test {

using ::testing::Each;
using ::testing::ElementsAre;

TEST(BoundedTasks, RunsEveryTaskOnce) {
  for (const std::size_t threads : {1U, 3U}) {
    BoundedTasks tasks(threads, 2);
    std::vector<std::atomic<int>> runs(300);
    for (std::atomic<int>& count : runs) tasks.enqueue([&count] { ++count; });
    tasks.shutdown();
    for (const std::atomic<int>& count : runs) ASSERT_EQ(count, 1);
  }
}

// Each task ends only when as many others have begun as there are threads.
TEST(BoundedTasks, RunsAsManyTasksAtOnceAsItHasThreads) {
  constexpr int kThreads = 4;
  BoundedTasks tasks(kThreads, 64);
  std::barrier all(kThreads);
  std::atomic<int> now = 0, most = 0;
  for (int i = 0; i < 5 * kThreads; ++i)
    tasks.enqueue([&] {
      const int running = ++now;
      for (int before = most; running > before && !most.compare_exchange_weak(before, running);) {
      }
      all.arrive_and_wait();
      --now;
    });
  tasks.shutdown();
  EXPECT_EQ(now, 0);
  EXPECT_EQ(most, kThreads);
}

/// One thread, which waits in its first task until it is let go, and the numbers of its tasks in
/// the order in which they were run.
class OneThread : public ::testing::Test {
 protected:
  OneThread() {
    add(0);
    begun.wait();
  }
  void add(int number) {
    tasks.enqueue([this, number] {
      if (number == 0) {
        begun.count_down();
        go.wait();
      }
      order.push_back(number);
    });
  }
  std::latch begun{1}, go{1};
  std::vector<int> order;
  BoundedTasks tasks{1, 2};
};

TEST_F(OneThread, ATaskWaitsForItsPlaceAmongThosePending) {
  add(1);
  add(2);
  test::ObservedThread third([this] { add(3); });
  third.await_sleep();
  EXPECT_FALSE(third.ended());
  go.count_down();
  third.join();
  tasks.shutdown();
  EXPECT_THAT(order, ElementsAre(0, 1, 2, 3));
}

TEST_F(OneThread, TheEndRunsWhatIsPendingAndLetsNobodyWait) {
  add(1);
  add(2);
  test::ObservedThread third([this] { add(3); });
  third.await_sleep();
  test::ObservedThread end([this] { tasks.shutdown(); });
  third.join();  // although the first task still runs
  EXPECT_FALSE(end.ended());
  go.count_down();
  end.join();
  EXPECT_THAT(order, ElementsAre(0, 1, 2, 3));
}

}  // namespace bounded_tasks_test
}  // namespace placegraph::apps
