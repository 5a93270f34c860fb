#pragma once
#include <placegraph/frontend/labels/training/scene_training.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <string>
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

/// Reads an image in colour if the file has it. Throws FileError.
Image colour_of(const std::string& path);

/// Photographs of the set, then rendered streets, with labels as numbers of the model's classes.
/// Photographs are read on demand, rendered images are kept. They refer to `set` and `model`.
std::vector<SceneTrainingImage> training_images(const LabelledSet& set,
                                                const std::vector<LabelledImage>& images,
                                                const SceneModel& model,
                                                const TrainingImageOptions& options);

}  // namespace placegraph::apps
