#pragma once
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// The begin of every program: it greets, and answers by floats.
inline constexpr const char* kAnswering = R"(import os, struct, sys, time
stream, out = sys.stdin.buffer, sys.stdout.buffer
def read(count):
    data = stream.read(count)
    if len(data) < count: sys.exit(0)
    return data
def image():
    width, height, channels = struct.unpack("<3I", read(12))
    return width, height, channels, read(width * height * channels)
def answer(values):
    out.write(b"PGD1" + struct.pack(f"<I{len(values)}f", len(values), *values))
    out.flush()
assert stream.readline() == b"PLACEGRAPH RECOGNIZER 1\n"
)";

/// A program that describes an image by its size and by sums of its bytes.
inline constexpr const char* kSums = R"(while True:
    width, height, channels, pixels = image()
    answer([width, height, channels] + [sum(pixels[c::channels]) / 1e3 for c in range(channels)]
           + [sum(pixels[::7]) / 1e3, sum(pixels[:width * channels]) / 1e3])
)";

/// Programs of Python in a folder of their own.
class ScriptedProgram {
 public:
  /// The command that runs a program: kAnswering, and what follows it.
  std::string command(const std::string& rest) const {
    return "python3 " + folder_.write("program.py", kAnswering + rest);
  }
  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

/// An image of noise.
inline cv::Mat noise(int width, int height, int type, std::uint64_t seed) {
  cv::Mat image(height, width, type);
  cv::RNG random(seed + 1);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

}  // namespace placegraph::test
