#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace {

std::string located(const std::string& path, int line, const std::string& message) {
  std::string text = path;
  if (line > 0) text.append(":").append(std::to_string(line));
  return text.append(": ").append(message);
}

}  // namespace

FileError::FileError(const std::string& path, int line, const std::string& message)
    : Error(located(path, line, message)) {}

}  // namespace placegraph
