#include "apps/support/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace placegraph::apps {
namespace {
constexpr std::chrono::milliseconds kTerminalInterval{200};
constexpr std::chrono::seconds kQuietInterval{10};
}  // namespace

void Pace::update(std::int64_t done, Clock::time_point now) {
  if (done_ < 0 || done < done_) {
    base_ = done;
    begin_ = now;
  }
  done_ = done;
  now_ = now;
}

std::optional<double> Pace::rate() const {
  const double seconds = std::chrono::duration<double>(now_ - begin_).count();
  if (done_ <= base_ || !(seconds > 0)) return std::nullopt;
  return static_cast<double>(done_ - base_) / seconds;
}

std::string progress_text(std::int64_t done, std::int64_t total, std::optional<double> rate,
                          const std::string& unit) {
  std::string text = fmt::format("{}/{} {}", done, total, unit);
  if (!rate) return text;
  const auto left_s = static_cast<std::int64_t>(static_cast<double>(total - done) / *rate + 0.5);
  return text + fmt::format(", {:.1f}/s, {}:{:02} left", *rate, left_s / 60, left_s % 60);
}

Progress::Progress(std::string what, std::int64_t total, std::string unit)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(Clock::now() +
            (terminal_ ? Clock::duration(kTerminalInterval) : Clock::duration(kQuietInterval))) {}

Progress::~Progress() {
  if (width_ > 0) std::fputc('\n', stderr);
}

void Progress::update(std::int64_t done) {
  const Clock::time_point now = Clock::now();
  pace_.update(done, now);
  if (now < next_ && !(terminal_ && done == total_)) return;
  const std::string text = what_ + ": " + progress_text(done, total_, pace_.rate(), unit_);
  if (terminal_) {
    // Blanks overwrite what a longer line before left behind.
    const std::size_t blanks = width_ > text.size() ? width_ - text.size() : 0;
    std::fprintf(stderr, "\r%s%s", text.c_str(), std::string(blanks, ' ').c_str());
    std::fflush(stderr);
    width_ = text.size();
    next_ = now + kTerminalInterval;
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
    next_ = now + kQuietInterval;
  }
}

void Progress::print(const std::string& line) {
  const std::size_t blanks = width_ > line.size() ? width_ - line.size() : 0;
  std::fprintf(stderr, "%s%s%s\n", width_ > 0 ? "\r" : "", line.c_str(),
               std::string(blanks, ' ').c_str());
  width_ = 0;
}

}  // namespace placegraph::apps
