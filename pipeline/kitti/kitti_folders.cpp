#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/pipeline/kitti/kitti_folders.h>

#include <algorithm>
#include <filesystem>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

bool is_sequence_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, is_digit);
}

}  // namespace

PoseFolder pose_folder(const std::string& path) {
  if (!fs::is_directory(path)) throw FileError(path, "is no folder");
  PoseFolder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const bool is_folder = entry.is_directory();
    const fs::path file = is_folder ? entry.path() / "poses.txt" : entry.path();
    const std::string name = is_folder ? entry.path().filename().string() : file.stem().string();
    if (is_sequence_name(name) && fs::is_regular_file(file) && file.extension() == ".txt") {
      const bool is_new = folder.files.emplace(name, file.string()).second;
      require(is_new, path + ": both " + name + ".txt and " + name + "/poses.txt are there");
    } else if (!is_folder && file.filename().string().front() != '.') {
      folder.others.push_back(file.string());
    }
  }
  require(!folder.files.empty(),
          path + ": holds no poses of a sequence (00.txt, 01.txt ..., or 00/poses.txt ...)");
  std::ranges::sort(folder.others);
  return folder;
}

}  // namespace placegraph
