#pragma once
#include <placegraph/frontend/internal/labels/scene_labeller.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What `scene label` and `scene surfaces` have in common: pictures in, label images out.
struct ScenePictureArguments {
  std::string input;           ///< an image, or a folder of them (or with them in images/)
  std::string out;             ///< folder for NAME.png
  std::string model;           ///< in place of the one that came with the program; empty: that
  std::string surfaces_model;  ///< the same of surfaces, for `scene label`
  double unknown_below = 0;    ///< less sure pixels get the number after the last class
  int threads = 1;             ///< pictures at a time
  bool relations = false;      ///< the table of what lies above and beside what counts too
  bool confidence = false;     ///< NAME.confidence.png is written too
  bool draw = false;           ///< NAME.drawn.png is written too
  bool force = false;          ///< write into a folder that is not empty
};

struct ScenePictureResult {
  std::string out;
  std::vector<std::string> classes;
  std::vector<std::int64_t> pixels;  ///< of each class, then unknown ones
  std::size_t pictures = 0;
  double cpu_ms_a_picture = 0;
};

/// Labels every picture of the folder or the one picture by `label`, writes OUT/NAME.png of class
/// numbers, and on demand NAME.confidence.png and NAME.drawn.png. Progress goes to stderr. Throws
/// ArgumentError, and FileError also where two pictures would have one name.
ScenePictureResult label_pictures(const ScenePictureArguments& arguments,
                                  const std::vector<std::string>& classes,
                                  const std::function<SceneLabels(const SceneView&)>& label);

/// How much of the pictures is what, in one line.
std::string to_text(const ScenePictureResult& result);
std::string to_json(const ScenePictureResult& result);

/// A colour for each class, the picture under it, and black where it is unknown.
Image draw_labels(const Image& bgr, const Image& labels, int classes);

}  // namespace placegraph::apps
