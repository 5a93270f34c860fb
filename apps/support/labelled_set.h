#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// A picture whose pixels people labelled.
struct LabelledPicture {
  std::string image, labels;  ///< paths
  std::string sequence;       ///< of the drive it is from: its name up to the first '_'
};

/// A folder DATA with images/ and labels/ (of the same names), or with them in train/, and in val/
/// if there is one; and CLASSES.txt.
struct LabelledSet {
  std::vector<SceneClass> classes;
  std::vector<LabelledPicture> train, val;
};

/// Throws FileError: no CLASSES.txt, no images, an image without labels.
LabelledSet read_labelled_set(const std::string& folder);

/// Labels numbered by `classes` as numbers into `names`, 255 where they are void. `surfaces`: by
/// what surface a class is, else by its name. Throws FileError of `origin` if they are no label
/// image or hold a number that is no class.
Image class_image(const Image& labels, const std::string& origin,
                  const std::vector<SceneClass>& classes, const std::vector<std::string>& names,
                  bool surfaces);

/// The same of a file.
Image read_class_image(const std::string& path, const std::vector<SceneClass>& classes,
                       const std::vector<std::string>& names, bool surfaces);

}  // namespace placegraph::apps
