#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/recognizers/exec_describer.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

static_assert(std::endian::native == std::endian::little);

// The words of docs/recognizers.md.
constexpr std::string_view kGreeting = "PLACEGRAPH RECOGNIZER 1\n", kAnswer = "PGD1";
// Longer descriptors are a mistake: of ten thousand images they would need 40 GB.
constexpr std::uint32_t kLongest = 1 << 20;

void append(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Width, height, channels and the rows of an image; colour as red, green, blue.
std::string message_of(const Image& image) {
  cv::Mat pixels;  // of its own, as the image must not change
  if (image.channels() == 3)
    cv::cvtColor(image, pixels, cv::COLOR_BGR2RGB);
  else
    pixels = image;
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(pixels.cols));
  append(bytes, static_cast<std::uint32_t>(pixels.rows));
  append(bytes, static_cast<std::uint32_t>(pixels.channels()));
  const std::size_t row = static_cast<std::size_t>(pixels.cols) * pixels.elemSize();
  bytes.reserve(bytes.size() + row * static_cast<std::size_t>(pixels.rows));
  for (int y = 0; y < pixels.rows; ++y)
    bytes.append(reinterpret_cast<const char*>(pixels.ptr(y)), row);
  return bytes;
}

/// The first line, short, and without what a terminal would obey.
std::string shown(std::string text) {
  constexpr std::size_t kMost = 200;
  text.resize(std::min({text.size(), text.find_first_of("\r\n"), kMost}));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text;
}

}  // namespace

std::vector<std::string> words_of_command(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && (c == ' ' || c == '\t')) {
      if (inside) words.push_back(std::exchange(word, {}));
      inside = false;
      continue;
    }
    inside = true;
    if (quote != '\'' && c == '\\' && i + 1 < command.size()) {
      word += command[++i];
    } else if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else {
      word += c;
    }
  }
  require(quote == 0, fmt::format("{}: a quote is not closed", command));
  if (inside) words.push_back(word);
  return words;
}

ExecDescriber::ExecDescriber(std::string command, double timeout_s)
    : command_(std::move(command)), words_(words_of_command(command_)), timeout_s_(timeout_s) {
  require(!words_.empty(), "recognizer exec: no program is named");
}

void ExecDescriber::fail(FrameId frame, const std::string& problem) {
  process_.reset();
  throw ArgumentError(
      fmt::format("recognizer exec:{}: image {}: {}", command_, frame.value(), problem));
}

void ExecDescriber::fail_as(ChildProcess::State state, FrameId frame) {
  if (state == ChildProcess::State::kTimedOut)
    fail(frame, fmt::format("no answer within {} s (describer.timeout_s)", timeout_s_));
  const std::string how = process_->end();
  const std::string last = shown(process_->last_error_line());
  fail(frame, fmt::format("the program {}{}", how,
                          last.empty() ? " without a message" : "; its last line: " + last));
}

/// Length of the descriptor of an answer, whose begin was received if the state is kDone.
std::uint32_t ExecDescriber::length_of_answer(ChildProcess::State state, FrameId frame) {
  const std::string& answer = process_->received();
  const auto same = std::min(answer.size(), kAnswer.size());
  if (answer.compare(0, same, kAnswer, 0, same) != 0)
    fail(frame, fmt::format("the program wrote '{}' to its standard output, which is for "
                            "descriptors; messages belong to its standard error",
                            shown(answer)));
  if (state != ChildProcess::State::kDone) fail_as(state, frame);
  std::uint32_t length = 0;
  std::memcpy(&length, answer.data() + kAnswer.size(), sizeof length);
  if (length == 0 || length > kLongest)
    fail(frame, fmt::format("a descriptor of {} values; 1 to {} are allowed", length, kLongest));
  if (length_ != 0 && length != length_)
    fail(frame, fmt::format("a descriptor of {} values, those before have {}", length, length_));
  return length;
}

std::vector<float> ExecDescriber::describe(const Image& image, FrameId frame) {
  require(!began_ || process_, fmt::format("recognizer exec:{}: it has failed before", command_));
  std::string message;
  if (!began_) {
    try {
      process_ = std::make_unique<ChildProcess>(words_);
    } catch (const ArgumentError& error) {
      throw ArgumentError(fmt::format("recognizer exec:{}: {}", command_, error.what()));
    }
    began_ = true;
    message = kGreeting;
  }
  message += message_of(image);
  const auto deadline =
      ChildProcess::Clock::now() + std::chrono::duration_cast<ChildProcess::Clock::duration>(
                                       std::chrono::duration<double>(timeout_s_));
  try {
    constexpr std::size_t kHead = kAnswer.size() + sizeof(std::uint32_t);
    length_ = length_of_answer(process_->transfer(message, kHead, deadline), frame);
    const std::size_t size = length_ * sizeof(float);
    const auto state = process_->transfer({}, kHead + size, deadline);
    if (state != ChildProcess::State::kDone) fail_as(state, frame);
    std::vector<float> descriptor(length_);
    std::memcpy(descriptor.data(), process_->received().data() + kHead, size);
    process_->take(kHead + size);
    return descriptor;
  } catch (...) {
    process_.reset();  // an interruption leaves it in the middle of an answer
    throw;
  }
}

}  // namespace placegraph
