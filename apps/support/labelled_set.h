#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// An image with labelled pixels.
struct LabelledImage {
  std::string image, labels;  ///< paths
  std::string sequence;       ///< name of its sequence: the file name up to the first '_'
};

/// Images and labels of a folder DATA with CLASSES.txt.
/// DATA has images/ and labels/ (with the same names), or has them in train/ and optionally in
/// val/.
struct LabelledSet {
  std::vector<SceneClass> classes;
  std::vector<LabelledImage> train, val;
};

/// Reads a labelled set. Throws FileError without CLASSES.txt, images, or labels of an image.
LabelledSet read_labelled_set(const std::string& folder);

/// Converts labels numbered by `classes` to indices of `names`; void labels become 255.
/// With `surfaces` a class is matched by its surface, else by its name. Throws FileError with the
/// name `origin` if the labels are no label image or have a number without a class.
Image class_image(const Image& labels, const std::string& origin,
                  const std::vector<SceneClass>& classes, const std::vector<std::string>& names,
                  bool surfaces);

/// The same for a file.
Image read_class_image(const std::string& path, const std::vector<SceneClass>& classes,
                       const std::vector<std::string>& names, bool surfaces);

}  // namespace placegraph::apps
