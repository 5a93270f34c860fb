#include "apps/support/output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <opencv2/core.hpp>

namespace placegraph::apps {
namespace {

[[noreturn]] void fail_to_print() {
  throw Error(std::string("standard output cannot be written: ") + std::strerror(errno));
}

/// Whether a terminal may take the byte as a command: a control character of ASCII, or one of
/// U+0080 to U+009F, of which this is the first or the second byte.
bool is_control(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const auto second = [&](std::size_t k) {
    return k > 0 && k < text.size() && byte(k - 1) == 0xc2 && byte(k) >= 0x80 && byte(k) < 0xa0;
  };
  return byte(i) < 0x20 || byte(i) == 0x7f || second(i) || second(i + 1);
}

/// The line without its middle if it is long; no character of UTF-8 is cut.
std::string shortened(const std::string& line) {
  constexpr std::size_t kLongest = 1000, kBegin = 600, kEnd = 300;
  if (line.size() <= kLongest) return line;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(line[i]) & 0xc0) == 0x80;
  };
  std::size_t begin = kBegin, end = line.size() - kEnd;
  while (begin > 0 && continues(begin)) --begin;
  while (end < line.size() && continues(end)) ++end;
  return line.substr(0, begin) + " ... " + line.substr(end);
}

/// Whether an exception is of this kind.
template <class Kind>
bool is_kind(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

}  // namespace

Failure failure_of(const std::exception& error) {
  if (is_kind<NoResult>(error)) return {ExitCode::kNoResult, error.what()};
  if (is_kind<Interrupted>(error)) return {ExitCode::kInterrupted, error.what()};
  if (is_kind<Error>(error) || is_kind<std::filesystem::filesystem_error>(error))
    return {ExitCode::kUsage, error.what()};
  const auto* of_images = dynamic_cast<const cv::Exception*>(&error);
  if (is_kind<std::bad_alloc>(error) || (of_images && of_images->code == cv::Error::StsNoMem))
    return {ExitCode::kInternal, "there is not enough memory"};
  return {ExitCode::kInternal,
          std::string("internal error, please report it with the command: ") + error.what()};
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail_to_print();
}

void finish_printing() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail_to_print();
}

void note(const std::string& message) {
  std::fprintf(stderr, "%s\n", one_line(message).c_str());
}

LogSink option_notes() {
  return [](LogLevel, const std::string& message) { note(message); };
}

LogSink messages() {
  return [](LogLevel level, const std::string& message) {
    if (level == LogLevel::kWarning) warn(message);
    if (level == LogLevel::kInfo) note(message);
  };
}

void warn(const std::string& message) {
  std::fprintf(stderr, "warning: %s\n", one_line(message).c_str());
}

Trajectory warned(Trajectory trajectory) {
  for (const std::string& warning : trajectory.warnings) warn(warning);
  return trajectory;
}

std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (is_control(text, i) && !space)
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else if (!space)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return shortened(line);
}

}  // namespace placegraph::apps
