#include "apps/server/plugin/bounded_tasks.h"

namespace placegraph::apps {

BoundedTasks::BoundedTasks(std::size_t threads, std::size_t most_pending)
    : most_pending_(most_pending) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

void BoundedTasks::enqueue(std::function<void()> task) {
  std::unique_lock lock(mutex_);
  while (pending_.size() >= most_pending_ && !ended_) changed_.wait(lock);
  pending_.push_back(std::move(task));
  changed_.notify_all();
}

void BoundedTasks::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

/// Tasks that are pending at the end are still run: each closes its connection.
void BoundedTasks::work() {
  for (;;) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      while (pending_.empty() && !ended_) changed_.wait(lock);
      if (pending_.empty()) return;
      task = std::move(pending_.front());
      pending_.pop_front();
      changed_.notify_all();
    }
    task();
  }
}

}  // namespace placegraph::apps
