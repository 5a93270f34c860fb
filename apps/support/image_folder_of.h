#pragma once
#include <filesystem>
#include <string>

namespace placegraph::apps {

/// Folder of the images: images/ or image_0/ in `folder` if there is one, else `folder`.
inline std::string image_folder_of(const std::string& folder) {
  for (const char* name : {"images", "image_0"}) {
    const std::filesystem::path inside = std::filesystem::path(folder) / name;
    if (std::filesystem::is_directory(inside)) return inside.string();
  }
  return folder;
}

}  // namespace placegraph::apps
