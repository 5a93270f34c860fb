#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace placegraph {

/// The numbers of a binary file of COLMAP, one after the other.
/// Throws FileError if the file is missing or ends too early or too late.
class ColmapBytes {
 public:
  explicit ColmapBytes(std::string path) : path_(std::move(path)) {
    require_input_file(path_);
    std::ifstream stream(path_, std::ios::binary);
    if (!stream) throw FileError(path_, "cannot be opened");
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    if (stream.bad()) throw FileError(path_, "cannot be read");
  }
  template <class Number>
  Number next() {
    Number number{};
    if (bytes_.size() - at_ < sizeof number) throw FileError(path_, "truncated");
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  double next_finite() {
    const auto number = next<double>();
    if (!std::isfinite(number)) throw FileError(path_, "a number is not finite");
    return number;
  }
  std::string next_name() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) throw FileError(path_, "truncated");
    std::string name = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return name;
  }
  void end() const {
    if (at_ != bytes_.size()) throw FileError(path_, "bytes after the last entry");
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_, bytes_;
  std::size_t at_ = 0;
};

}  // namespace placegraph
