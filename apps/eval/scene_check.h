#pragma once
#include <placegraph/eval/scene/label_check.h>

#include <cstddef>
#include <string>
#include <vector>

namespace placegraph::apps {

struct SceneCheckArguments {
  std::string labels;   ///< folder of scene_label or scene_surfaces; confidences are evaluated too
  std::string data;     ///< folder with images/ and labels/, CLASSES.txt in it or above it
  std::string classes;  ///< CLASSES.txt of `labels`; empty: that of `data`
  bool surfaces = false;   ///< `labels` are classes of surfaces
  bool confusion = false;  ///< also report the confusion matrix
};

struct SceneCheckResult {
  std::size_t images = 0;
  std::vector<std::string> names;  ///< names of the classes
  LabelCheck check;                ///< result over all images
  bool confusion = false;          ///< report the confusion matrix
};

/// Evaluates label images against annotated ones: `placegraph eval labels`.
/// Throws FileError if an image is missing, has another size, or is no label image.
SceneCheckResult scene_check(const SceneCheckArguments& arguments);

/// One line, and one line per class.
std::string to_text(const SceneCheckResult& result);
std::string to_json(const SceneCheckResult& result);

}  // namespace placegraph::apps
