#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/synthetic/writers/sequence_folder.h>

#include <fstream>

namespace placegraph::synthetic {
namespace fs = std::filesystem;

SequenceFolder::SequenceFolder(const std::string& path, bool force)
    : target_(fs::absolute(path).lexically_normal()) {
  if (target_.filename().empty()) target_ = target_.parent_path();
  if (fs::exists(target_)) {
    require(fs::is_directory(target_), path + ": is a file, a folder is to be written there");
    require(force || fs::is_empty(target_), path + ": is not empty; --force writes into it");
  }
  temporary_ = target_.parent_path() / fmt::format(".{}.partial", target_.filename().string());
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  make("");
}

SequenceFolder::~SequenceFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void SequenceFolder::make(const std::string& folder) const {
  std::error_code failure;
  fs::create_directories(temporary_ / folder, failure);
  if (failure)
    throw FileError((temporary_ / folder).string(), "cannot be created: " + failure.message());
}

void SequenceFolder::write(const std::string& file, const Image& image) const {
  // Noise does not compress, and speed matters more.
  write(file, encode_png(image, {.level = 1, .runs_only = true}));
}

void SequenceFolder::write(const std::string& file, const std::string& text) const {
  const fs::path path = temporary_ / file;
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw FileError(path.string(), "cannot be written");
}

void SequenceFolder::put_in_place(const std::vector<std::string>& parts) {
  try {
    if (!fs::exists(target_) || fs::is_empty(target_)) {
      fs::remove(target_);
      fs::rename(temporary_, target_);
      return;
    }
    for (const std::string& part : parts) {
      fs::remove_all(target_ / part);
      if (fs::exists(temporary_ / part)) fs::rename(temporary_ / part, target_ / part);
    }
  } catch (const fs::filesystem_error& error) {
    throw FileError(target_.string(), "cannot be put in place: " + error.code().message());
  }
}

}  // namespace placegraph::synthetic
