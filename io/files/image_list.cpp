#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/name_order.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

namespace placegraph {
namespace fs = std::filesystem;
bool has_image_extension(const std::string& path) {
  static constexpr std::array<std::string_view, 8> kExtensions = {".png", ".jpg", ".jpeg", ".pgm",
                                                                  ".ppm", ".bmp", ".tif",  ".tiff"};
  std::string extension = fs::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return (c >= 'A' && c <= 'Z') ? c + ('a' - 'A') : c; });
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

namespace {

std::vector<fs::path> images_in(const std::string& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw FileError(folder, "folder of images cannot be read: " + error.message());
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : entries) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (!hidden && has_image_extension(entry.path().string()) && !entry.is_directory()) {
      images.push_back(entry.path());
    }
  }
  return images;
}

/// Rejects `7.png` beside `7.jpg`, because the frame is ambiguous.
void require_one_a_name(const std::vector<std::string>& images) {
  std::vector<std::pair<std::string, std::string>> stems;
  for (const std::string& image : images)
    stems.emplace_back(fs::path(image).stem().string(), image);
  std::ranges::sort(stems);
  for (std::size_t i = 1; i < stems.size(); ++i)
    if (stems[i].first == stems[i - 1].first)
      throw FileError(stems[i].second, "is the same frame as " +
                                           fs::path(stems[i - 1].second).filename().string() +
                                           ": only one of them may be there");
}

}  // namespace

std::vector<std::string> list_numbered_images(const std::string& folder) {
  std::vector<std::pair<std::int64_t, std::string>> numbered;
  for (const fs::path& path : images_in(folder)) {
    const std::string stem = path.stem().string();
    const bool number = !stem.empty() && stem.size() < 18 && std::ranges::all_of(stem, is_digit);
    if (number) numbered.emplace_back(std::stoll(stem), path.string());
  }
  if (numbered.empty()) throw FileError(folder, "holds no images 000000.png, 000001.png, ...");
  std::ranges::sort(numbered);
  std::vector<std::string> images;
  images.reserve(numbered.size());
  for (const auto& [number, path] : numbered) {
    const auto expected = static_cast<std::int64_t>(images.size());
    if (number < expected) throw FileError(path, fmt::format("image {} is there twice", number));
    if (number > expected) {
      throw FileError(folder, fmt::format("image {:06d}.* is missing (the last is {:06d})",
                                          expected, numbered.back().first));
    }
    images.push_back(path);
  }
  return images;
}

std::vector<std::string> list_images(const std::string& folder) {
  std::vector<std::string> images;
  for (const fs::path& path : images_in(folder)) images.push_back(path.string());
  if (images.empty()) {
    const std::string around = images_around(folder);
    throw FileError(folder, "holds no images" + (around.empty() ? "" : "; there are " + around));
  }
  require_one_a_name(images);
  sort_by_name(images);
  return images;
}

bool holds_images(const std::string& folder) {
  return fs::is_directory(folder) && !images_in(folder).empty();
}

std::string images_around(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> folders = {fs::path(folder)};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error)) folders.push_back(entry.path());
  std::ranges::sort(folders);
  std::string text;
  for (const fs::path& path : folders) {
    const std::size_t count = images_in(path.string()).size();
    if (count == 0) continue;
    const std::string name =
        path == fs::path(folder) ? "the folder itself" : path.filename().string() + "/";
    text += fmt::format("{}{} images in {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

}  // namespace placegraph
