#pragma once
#include <httplib.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace placegraph::apps {

/// Threads that serve connections. While as many connections as allowed are pending, no further one
/// is accepted: they stay with the system and use no descriptors of the program.
class BoundedTasks : public httplib::TaskQueue {
 public:
  BoundedTasks(std::size_t threads, std::size_t most_pending);
  ~BoundedTasks() override = default;

  void enqueue(std::function<void()> task) override;
  void shutdown() override;

 private:
  void work();

  const std::size_t most_pending_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> pending_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace placegraph::apps
