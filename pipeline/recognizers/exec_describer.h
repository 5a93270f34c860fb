#pragma once
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/pipeline/recognizers/child_process.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace placegraph {

/// Asks a program for the descriptors of images, by the protocol of docs/recognizers.md.
///
/// One process serves all images: it is started for the first one, and ended with this object.
/// ArgumentError, in one line, with the command and the image, reports a program that cannot be
/// started, that ends, that does not answer in time, or whose answer breaks the protocol; the
/// program is ended then, and every later call fails, too.
class ExecDescriber : public ImageDescriber {
 public:
  /// `command`: words divided by spaces (words_of_command). `timeout_s`: the longest time for one
  /// image. Throws ArgumentError for a command without words or with an open quote.
  ExecDescriber(std::string command, double timeout_s);

  std::vector<float> describe(const Image& image, FrameId frame) override;

 private:
  [[noreturn]] void fail(FrameId frame, const std::string& problem);
  [[noreturn]] void fail_as(ChildProcess::State state, FrameId frame);
  std::uint32_t length_of_answer(ChildProcess::State state, FrameId frame);

  std::string command_;
  std::vector<std::string> words_;
  double timeout_s_;
  bool began_ = false;
  std::uint32_t length_ = 0;  ///< of a descriptor; 0: none yet
  std::unique_ptr<ChildProcess> process_;
};

/// The words of a command, divided by blanks.
///
/// Quotes ('...' and "...") keep the blanks of a word, a backslash outside '...' the next
/// character. Nothing else is special: there is no shell. Throws ArgumentError for an open quote.
std::vector<std::string> words_of_command(const std::string& command);

}  // namespace placegraph
