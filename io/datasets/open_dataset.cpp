#include <fmt/format.h>
#include <placegraph/io/datasets/euroc.h>
#include <placegraph/io/datasets/image_folder.h>
#include <placegraph/io/datasets/kitti_drive.h>
#include <placegraph/io/datasets/kitti_odometry.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/datasets/seven_scenes.h>
#include <placegraph/io/datasets/tum_rgbd.h>
#include <placegraph/io/datasets/video_file.h>
#include <placegraph/io/files/image_list.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace placegraph {
namespace fs = std::filesystem;

namespace {

/// A layout: its test and its reader.
struct Layout {
  bool (*is)(const std::string& path);
  std::unique_ptr<Dataset> (*open)(const std::string& path);
};

/// Layouts in the order of their tests.
constexpr Layout kLayouts[] = {
    {is_video_file, open_video_file},    {is_euroc, open_euroc},
    {is_tum_rgbd, open_tum_rgbd},        {is_kitti_odometry, open_kitti_odometry},
    {is_kitti_drive, open_kitti_drive},  {is_seven_scenes, open_seven_scenes},
    {is_image_folder, open_image_folder}};

const Layout* layout_of(const std::string& path) {
  for (const Layout& layout : kLayouts)
    if (layout.is(path)) return &layout;
  return nullptr;
}

/// Names of the folders inside that are sequences: "seq-01, seq-02 and 3 more"; empty if none.
std::string sequences_inside(const fs::path& folder) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error) && layout_of(entry.path().string()) != nullptr)
      names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamed) text += fmt::format(" and {} more", names.size() - kNamed);
  return text;
}

/// Describes what a folder lacks to be a sequence; empty if that is not evident.
std::string what_is_missing(const fs::path& folder) {
  if (const std::string inside = sequences_inside(folder); !inside.empty())
    return "it contains the sequences " + inside + ": name one of them";
  for (const char* camera : {"image_0", "image_2"})
    if (holds_images((folder / camera).string()))
      return fmt::format("calib.txt is missing (KITTI: a line P{}: with twelve numbers)",
                         camera + 6);
  for (const char* images : {".", "left", "images", "image", "rgb"})
    if (holds_images((folder / images).string()))
      return "calibration.yaml is missing (docs/datasets.md describes its keys)";
  return "";
}

}  // namespace

bool is_sequence(const std::string& path) { return layout_of(path) != nullptr; }

std::unique_ptr<Dataset> open_dataset(const std::string& path) {
  if (!fs::exists(path)) throw FileError(path, "no such file or folder");
  if (const Layout* layout = layout_of(path)) return layout->open(path);
  const bool is_folder = fs::is_directory(path);
  const std::string around = is_folder ? images_around(path) : "";
  const std::string missing = is_folder ? what_is_missing(path) : "";
  throw UnknownLayout(
      path,
      "no sequence is recognized here" + (missing.empty() ? "" : ": " + missing) +
          "; looked for mav0/cam0 (EuRoC), rgb.txt or associations.txt (TUM, ICL-NUIM), calib.txt "
          "with "
          "image_0 or image_2 (KITTI odometry), image_00/data (KITTI raw), frame-000000.color.png "
          "(7-Scenes), calibration.yaml (images), or a video file (avi mkv mov mp4 m4v mpg webm)" +
          (around.empty() ? "" : "; there are " + around));
}

}  // namespace placegraph
