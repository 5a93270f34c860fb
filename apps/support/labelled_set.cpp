#include "apps/support/labelled_set.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/measurements/class_list.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
constexpr std::uint8_t kVoid = 255;

std::vector<LabelledImage> labelled_images_of(const fs::path& folder) {
  std::vector<LabelledImage> images;
  for (const std::string& image : list_images((folder / "images").string())) {
    const std::string name = fs::path(image).stem().string();
    const fs::path labels = folder / "labels" / (name + ".png");
    if (!fs::is_regular_file(labels))
      throw FileError(labels.string(), "missing: the labels of " + image);
    images.push_back({image, labels.string(), name.substr(0, name.find('_'))});
  }
  return images;
}

}  // namespace

LabelledSet read_labelled_set(const std::string& folder) {
  const fs::path root = folder;
  const bool splits = fs::is_directory(root / "train");
  fs::path list = root / "CLASSES.txt";
  if (!splits && !fs::exists(list)) list = root.parent_path() / "CLASSES.txt";
  LabelledSet set;
  set.classes = read_class_list(list.string());
  set.train = labelled_images_of(splits ? root / "train" : root);
  if (splits && fs::is_directory(root / "val")) set.val = labelled_images_of(root / "val");
  return set;
}

Image class_image(const Image& labels, const std::string& origin,
                  const std::vector<SceneClass>& classes, const std::vector<std::string>& names,
                  bool surfaces) {
  constexpr int kUnheard = -1;
  std::array<int, 256> table;
  table.fill(kUnheard);
  for (const SceneClass& c : classes) {
    const std::string& name = surfaces && c.surface ? surface_name(*c.surface) : c.name;
    const auto at = std::find(names.begin(), names.end(), name);
    table[static_cast<std::size_t>(c.id)] =
        c.surface && at != names.end() ? static_cast<int>(at - names.begin()) : kVoid;
  }
  if (labels.type() != CV_8UC1)
    throw FileError(origin, "no label image: one channel of 8 bits is needed");
  Image result(labels.size(), CV_8UC1);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u) {
      const int number = table[labels.at<std::uint8_t>(v, u)];
      if (number == kUnheard)
        throw FileError(origin, "class " + std::to_string(labels.at<std::uint8_t>(v, u)) + " at " +
                                    std::to_string(u) + " " + std::to_string(v) +
                                    " is not in CLASSES.txt");
      result.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(number);
    }
  return result;
}

Image read_class_image(const std::string& path, const std::vector<SceneClass>& classes,
                       const std::vector<std::string>& names, bool surfaces) {
  return class_image(read_image_as_stored(path), path, classes, names, surfaces);
}

}  // namespace placegraph::apps
