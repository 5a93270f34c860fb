#pragma once
#include <placegraph/frontend/labels/scene_labels.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Arguments of `image labels` and `image surfaces`: images in, label images out.
struct SceneImageArguments {
  std::string input;  ///< image, or folder of images (or with images in images/)
  std::string out;    ///< folder for NAME.png
  std::string model;  ///< model to use instead of the installed one; empty: the installed one
  std::string surfaces_model;  ///< the same for surfaces, for `image labels`
  /// For `image labels`, where none of the classes may be visible: `sequence` judges it over
  /// neighbouring images, `each` image by image; `street`: every image shows a street.
  std::string surroundings = "sequence";
  double unknown_below =
      0;                    ///< pixels with a lower probability get the number after the last class
  int threads = 1;          ///< number of threads
  bool relations = false;   ///< use the table of spatial relations between classes
  bool confidence = false;  ///< also write NAME.confidence.png
  bool ids = false;         ///< NAME.png has the numbers of the classes, not their colours
  bool draw = false;        ///< as `ids`, and the colours in NAME.drawn.png
  bool force = false;       ///< write into a folder that is not empty
};

struct SceneImageResult {
  std::string out;
  bool ids = false;  ///< the files have numbers
  std::vector<std::string> classes;
  std::vector<std::int64_t> pixels;  ///< number of pixels of each class, then of unknown ones
  std::size_t images = 0;
  double cpu_ms_an_image = 0;
};

/// The image, or the images of the folder in natural order. Throws FileError.
std::vector<std::string> image_paths_of(const std::string& input);

/// Labels the image of a number, from 0 on; `picture` is in colour or grey.
using ImageLabeller = std::function<SceneLabels(std::size_t image, const Image& picture)>;

/// Labels one image or every image of a folder by `label`.
/// Writes OUT/NAME.png, the image in the colours of its classes with a legend below, or their
/// numbers; on demand NAME.confidence.png and NAME.drawn.png.
/// Progress goes to stderr. Throws ArgumentError, and FileError also if two images would have the
/// same name.
SceneImageResult label_images(const SceneImageArguments& arguments,
                              const std::vector<std::string>& classes, const ImageLabeller& label);

/// Shares of the classes in one line.
std::string to_text(const SceneImageResult& result);
std::string to_json(const SceneImageResult& result);

/// The image in the colour of each pixel's class, as it is where that is unknown, and below it the
/// classes that it shows with their shares. `wanted` names the purpose.
Image draw_labels(const Image& bgr, const Image& labels, const std::vector<std::string>& classes,
                  const std::string& wanted);

}  // namespace placegraph::apps
