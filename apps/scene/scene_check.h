#pragma once
#include <placegraph/eval/internal/scene/label_check.h>

#include <cstddef>
#include <string>
#include <vector>

namespace placegraph::apps {

struct SceneCheckArguments {
  std::string labels;      ///< folder of scene_label or scene_surfaces; confidences are judged too
  std::string data;        ///< folder with images/ and labels/, CLASSES.txt in it or above it
  std::string classes;     ///< CLASSES.txt that numbers `labels`; empty: that of `data`
  bool surfaces = false;   ///< `labels` are surfaces
  bool confusion = false;  ///< pixels of each class by what they are called are told too
};

struct SceneCheckResult {
  std::size_t pictures = 0;
  std::vector<std::string> names;  ///< of the classes
  LabelCheck check;                ///< over all pictures
  bool confusion = false;          ///< asked for
};

/// `placegraph scene check`: judges label images by those that people made. Throws FileError where
/// one is missing, of another size, or no label image.
SceneCheckResult scene_check(const SceneCheckArguments& arguments);

/// One line, and one a class.
std::string to_text(const SceneCheckResult& result);
std::string to_json(const SceneCheckResult& result);

}  // namespace placegraph::apps
