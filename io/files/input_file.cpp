#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/file_bytes.h>
#include <placegraph/io/files/text_file.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace placegraph {

void require_input_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  switch (fs::status(path, error).type()) {
    case fs::file_type::directory:
      throw FileError(path, "is a folder, not a file");
    case fs::file_type::character:
    case fs::file_type::block:
      throw FileError(path, "is a device, not a file");
    case fs::file_type::socket:
      throw FileError(path, "is a socket, not a file");
    case fs::file_type::fifo:
      // A pipe of the shell has a name under /dev/fd alone, which leads to none in a folder.
      (void)fs::canonical(path, error);
      if (!error) throw FileError(path, "is a named pipe, not a file");
      break;
    default:
      break;
  }
}

std::string read_bytes(const std::string& path) {
  require_input_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path, "cannot be read");
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw FileError(path, "cannot be read");
  return bytes;
}

}  // namespace placegraph
