#pragma once
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// While it exists, `check` may end by an exception what this thread calls of the library.
///
/// It is called at most ten times a second, where the library calls check_interruption(). An inner
/// scope takes the place of an outer one. What a call was changing when it ended may be half
/// changed, and is to be destroyed; the threads that a call had started have ended.
class InterruptionScope {
 public:
  explicit InterruptionScope(std::function<void()> check);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

 private:
  friend void check_interruption();
  std::function<void()> check_;
  std::chrono::steady_clock::time_point checked_;
  InterruptionScope* outer_;
};

/// Called by every loop that may last: throws what the check of this thread's scope throws.
/// Without a scope, and in threads that the library started, it does nothing.
void check_interruption();

/// Calls fn(0) ... fn(count - 1) from `threads` threads (the caller's included) and waits.
///
/// The items must be independent. The first exception thrown is thrown again here. Between two
/// items the call may be interrupted.
inline void parallel_for(int count, int threads, const std::function<void(int)>& fn) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        check_interruption();
        fn(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads && i < count; ++i) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace placegraph
