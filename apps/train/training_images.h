#pragma once
#include <placegraph/frontend/labels/scene_training.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/support/labelled_set.h"

namespace placegraph::apps {

/// Images of the training set of a scene model, and their use.
struct TrainingImageOptions {
  std::vector<std::uint64_t> rendered;  ///< seeds of rendered towns; even ones have bad light
  int rendered_frames = 25;             ///< number of views of each town
  int every = 1;                        ///< use every n-th photograph
  int threads = 2;                      ///< number of threads; the result does not depend on it
  SceneTrainingOptions training;
};

/// An image of the training set with its labels as numbers of the model's classes.
/// Photographs are read on demand, rendered images are kept.
struct TrainingImage {
  std::string sequence;
  std::function<std::pair<Image, Image>()> read;
};

/// Reads an image in colour if the file has it. Throws FileError.
Image colour_of(const std::string& path);

/// Photographs of the set, then rendered streets. They refer to `set` and `model`.
std::vector<TrainingImage> training_images(const LabelledSet& set,
                                           const std::vector<LabelledImage>& images,
                                           const SceneModel& model,
                                           const TrainingImageOptions& options);

/// Divides every image into superpixels, once per variant; variants are consecutive blocks.
/// Progress goes to stderr. Throws FileError.
std::vector<SceneExample> make_examples(const std::vector<TrainingImage>& training_set,
                                        const SceneModel& model,
                                        const TrainingImageOptions& options);

}  // namespace placegraph::apps
