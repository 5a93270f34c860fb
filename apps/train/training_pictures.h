#pragma once
#include <placegraph/frontend/internal/labels/scene_training.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/support/labelled_set.h"

namespace placegraph::apps {

/// Which pictures a model of scenes is learned from, and how.
struct TrainingPictureOptions {
  std::vector<std::uint64_t> rendered;  ///< seeds of rendered towns; those even have bad light
  int rendered_frames = 25;             ///< views of each
  int every = 1;                        ///< every n-th photograph alone
  int threads = 2;                      ///< do not change the result
  SceneTrainingOptions training;
};

/// A picture to learn from: itself, and its labels as numbers of the model's classes. Photographs
/// are read when they are asked for, rendered ones are kept.
struct TrainingPicture {
  std::string sequence;
  std::function<std::pair<Image, Image>()> read;
};

/// A picture in colour where the file has it. Throws FileError.
Image colour_of(const std::string& path);

/// Photographs of the set, then rendered streets. They refer to `set` and `model`.
std::vector<TrainingPicture> training_pictures(const LabelledSet& set,
                                               const std::vector<LabelledPicture>& pictures,
                                               const SceneModel& model,
                                               const TrainingPictureOptions& options);

/// Cuts up every picture as often as there are variants; those of one variant follow each other.
/// Progress goes to stderr. Throws FileError.
std::vector<SceneExample> make_examples(const std::vector<TrainingPicture>& training_set,
                                        const SceneModel& model,
                                        const TrainingPictureOptions& options);

}  // namespace placegraph::apps
