#include <placegraph/graph/core/error.h>

namespace placegraph {

FileError::FileError(const std::string& path, int line, const std::string& message)
    : Error(path + (line > 0 ? ":" + std::to_string(line) : "") + ": " + message) {}

}  // namespace placegraph
