#include "apps/report/report_pictures.h"

#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/report/parts.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path.string(), "cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

json describe_pictures(const std::string& folder) {
  constexpr std::uintmax_t kMostBytes = 4'000'000;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".svg" &&
        entry.file_size() <= kMostBytes)
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  json pictures = json::array();
  for (const fs::path& path : paths)
    pictures.push_back(describe_picture(path.stem().string(), path.string(), content_of(path)));
  return pictures;
}

}  // namespace placegraph::apps
