#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace placegraph::apps {

/// The rate of work that counts up and may begin again.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// `done` is the count now. The first count, and one below the last, begin a stretch.
  void update(std::int64_t done, Clock::time_point now);
  /// Counts per second since the stretch began; nothing before its second count.
  std::optional<double> rate() const;

 private:
  std::int64_t base_ = 0, done_ = -1;  ///< first and last count of the stretch; -1: none
  Clock::time_point begin_, now_;
};

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
  using Clock = Pace::Clock;
  std::string what_, unit_;
  std::int64_t total_;
  bool terminal_;
  Pace pace_;
  Clock::time_point next_;
  std::size_t width_ = 0;
};

/// "123/1101 frames, 11.2/s, 1:27 left"; without a rate the first part alone.
std::string progress_text(std::int64_t done, std::int64_t total, std::optional<double> rate,
                          const std::string& unit);

}  // namespace placegraph::apps
