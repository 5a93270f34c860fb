#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace placegraph::apps {

/// Progress on stderr with rate and time left: one line rewritten in place on a terminal,
/// otherwise a new line every ten seconds. Not for several threads at once.
class Progress {
 public:
  /// `what` leads the line ("rendering"); `unit` names what is counted ("frames").
  Progress(std::string what, std::int64_t total, std::string unit = "frames");
  ~Progress();  ///< ends the line on a terminal
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the total are done.
  void update(std::int64_t done);

  /// Prints a line above the progress.
  void print(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_, unit_;
  std::int64_t total_;
  bool terminal_;
  Clock::time_point begin_, next_;
  std::size_t width_ = 0;
};

/// "123/1101 frames, 11.2/s, 1:27 left".
std::string progress_text(std::int64_t done, std::int64_t total, double seconds,
                          const std::string& unit);

}  // namespace placegraph::apps
