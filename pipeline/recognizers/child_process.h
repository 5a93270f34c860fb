#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// A program that is started once and talked with over its standard streams.
///
/// It is started without a shell, gets no other file of this process, and is in a process group of
/// its own: a signal of the terminal reaches it through this object alone, which ends the whole
/// group at the latest when it is destroyed. No zombie remains.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  enum class State {
    kDone,     ///< all is sent and received
    kEnded,    ///< the program has closed a stream, or ended
    kTimedOut  ///< nothing of it in time
  };

  /// Starts words[0], which is looked for in PATH, with the other words as arguments.
  /// Throws ArgumentError with the reason if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& words);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Sends `sent` and receives until received() has `wanted` bytes. All streams are served at the
  /// same time, so that neither side waits for the other. May be interrupted, see
  /// check_interruption().
  State transfer(std::string_view sent, std::size_t wanted, Clock::time_point deadline);
  /// What the program has written to its standard output and was not taken.
  const std::string& received() const { return received_; }
  /// Drops the first bytes of received().
  void take(std::size_t bytes) { received_.erase(0, bytes); }
  /// Ends the program, and says how it had ended by itself: "ended with exit code 1", "was ended by
  /// signal 11 (Segmentation fault)", or "closed its input or output" if it had not.
  std::string end();
  /// The last line that the program has written to its standard error; empty if there is none.
  std::string last_error_line() const;

 private:
  /// One end of a pipe; -1: closed.
  struct End {
    int fd = -1;
    ~End() { close(); }
    void close();
  };
  void start(const std::vector<std::string>& words, int in, int out, int error);
  bool serve(std::string_view& sent, int wait_ms);
  bool send(std::string_view& sent);
  bool receive(End& end, std::string& text);
  bool ends_within(Clock::duration time);

  End in_, out_, error_;  ///< its standard input, output and error
  pid_t process_ = -1;    ///< -1: ended
  std::string received_, errors_;
};

}  // namespace placegraph
