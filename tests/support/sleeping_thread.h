#pragma once
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace placegraph::test {

/// A thread of this process by whose state a test sees that it waits for something.
class ObservedThread {
 public:
  template <class Function>
  explicit ObservedThread(const Function& function)
      : thread_([this, function] {
          id_ = ::gettid();
          function();
          ended_ = true;
        }) {}
  ~ObservedThread() {
    if (thread_.joinable()) thread_.join();
  }
  ObservedThread(const ObservedThread&) = delete;
  ObservedThread& operator=(const ObservedThread&) = delete;

  void join() { thread_.join(); }
  bool ended() const { return ended_; }
  /// Returns when the thread sleeps in the kernel, or has ended.
  void await_sleep() const {
    while (!ended_ && !sleeps()) std::this_thread::yield();
  }

 private:
  bool sleeps() const {
    if (id_ == 0) return false;
    std::ifstream file("/proc/self/task/" + std::to_string(id_) + "/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t name_end = text.rfind(')');  // "ID (NAME) STATE ..."
    return name_end != std::string::npos && text.substr(name_end, 3) == ") S";
  }
  std::atomic<pid_t> id_ = 0;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace placegraph::test
