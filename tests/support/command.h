#pragma once
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace placegraph::test {

/// What a command left behind.
struct CommandResult {
  int code = -1;  ///< exit status; -1 if it was killed
  std::string out, err;
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_file(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// A folder of its own, removed with all its contents in the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "placegraph-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Runs `placegraph <arguments>` through the shell, in the given folder.
inline CommandResult run_placegraph(const std::string& arguments,
                                    const std::string& working_folder = ".") {
  const TemporaryFolder streams;
  const std::string command = "cd '" + working_folder + "' && '" + PLACEGRAPH_CLI + "' " +
                              arguments + " >'" + (streams / "out") + "' 2>'" + (streams / "err") +
                              "' </dev/null";
  const int status = std::system(command.c_str());
  CommandResult result;
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  result.out = read_file(streams / "out");
  result.err = read_file(streams / "err");
  return result;
}

}  // namespace placegraph::test
