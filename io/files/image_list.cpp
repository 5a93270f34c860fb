#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

bool has_image_extension(const fs::path& path) {
  static constexpr std::array<std::string_view, 8> kExtensions = {".png", ".jpg", ".jpeg", ".pgm",
                                                                  ".ppm", ".bmp", ".tif",  ".tiff"};
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return (c >= 'A' && c <= 'Z') ? c + ('a' - 'A') : c; });
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

std::vector<fs::path> images_in(const std::string& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw FileError(folder, "folder of images cannot be read: " + error.message());
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : entries) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (!hidden && has_image_extension(entry.path()) && !entry.is_directory()) {
      images.push_back(entry.path());
    }
  }
  return images;
}

std::string_view digits_at(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && is_digit(text[end])) ++end;
  return text.substr(begin, end - begin);
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      std::string_view x = digits_at(a, i), y = digits_at(b, j);
      i += x.size();
      j += y.size();
      x.remove_prefix(std::min(x.find_first_not_of('0'), x.size()));
      y.remove_prefix(std::min(y.find_first_not_of('0'), y.size()));
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  const std::size_t rest_a = a.size() - i, rest_b = b.size() - j;
  return rest_a != rest_b ? rest_a < rest_b : a < b;
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
  if (images.empty()) throw FileError(folder, "holds no images");
  std::ranges::sort(images, natural_less);
  return images;
}

}  // namespace placegraph
