#include "apps/train/training_pictures.h"

#include <placegraph/frontend/internal/labels/scene_variants.h>
#include <placegraph/graph/internal/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/internal/synthetic/worlds/synthetic_world.h>

#include <algorithm>

#include "apps/support/progress.h"
#include "apps/train/rendered_streets.h"

namespace placegraph::apps {
namespace {

/// Which of them are alike: so many of a drive one after the other (`block`), and never of two
/// sequences.
std::vector<int> blocks_of(const std::vector<TrainingPicture>& training_set,
                           const TrainingPictureOptions& a) {
  std::vector<int> block;
  int in_block = 0;
  for (std::size_t i = 0; i < training_set.size(); ++i) {
    const bool same = i > 0 && training_set[i].sequence == training_set[i - 1].sequence;
    const bool full = ++in_block > std::max(1, a.training.block / a.every);
    if (!same || full) in_block = 1;
    block.push_back(i == 0 ? 0 : block.back() + (!same || full ? 1 : 0));
  }
  return block;
}

}  // namespace

Image colour_of(const std::string& path) {
  const GreyAndColour read = read_image(path);
  return read.colour.empty() ? read.grey : read.colour;
}

std::vector<TrainingPicture> training_pictures(const LabelledSet& set,
                                               const std::vector<LabelledPicture>& pictures,
                                               const SceneModel& model,
                                               const TrainingPictureOptions& a) {
  const bool surfaces = model.kind == SceneModel::Kind::kSurfaces;
  const auto& names = model.classes;
  std::vector<TrainingPicture> training_set;
  for (const LabelledPicture& picture : pictures)
    training_set.push_back({picture.sequence, [&set, &names, picture, surfaces] {
                              return std::pair(
                                  colour_of(picture.image),
                                  read_class_image(picture.labels, set.classes, names, surfaces));
                            }});
  for (const RenderedPicture& picture : render_streets(a.rendered, a.rendered_frames, a.threads))
    training_set.push_back({picture.sequence, [&names, picture, surfaces] {
                              return std::pair(
                                  picture.image,
                                  class_image(picture.labels, picture.sequence,
                                              SyntheticWorld::scene_classes(), names, surfaces));
                            }});
  return training_set;
}

std::vector<SceneExample> make_examples(const std::vector<TrainingPicture>& training_set,
                                        const SceneModel& model, const TrainingPictureOptions& a) {
  const int count = static_cast<int>(training_set.size()), variants = a.training.variants;
  const std::vector<int> block = blocks_of(training_set, a);
  std::vector<SceneExample> examples(static_cast<std::size_t>(count * variants));
  Progress progress("looking", count * variants, "pictures");
  constexpr int kPart = 16;  // between two lines of progress
  for (int begin = 0; begin < count * variants; begin += kPart) {
    parallel_for(std::min(kPart, count * variants - begin), a.threads, [&](int k) {
      const auto at = static_cast<std::size_t>(begin + k), which = at % training_set.size();
      const std::size_t variant = at / training_set.size();
      const auto [picture, classes] = training_set[which].read();
      Image bgr = scene_picture(picture);
      Image labels = fit_labels(classes, bgr);
      if (variant > 0) {
        Random random(a.training.forest.seed, at);
        SceneVariant drawn = vary_scene(bgr, labels, 255, variant % 2 == 1, random);
        bgr = drawn.bgr, labels = drawn.labels;
      }
      examples[at] = make_example(bgr, labels, model.class_count(), block[which]);
    });
    progress.update(std::min(begin + kPart, count * variants));
  }
  return examples;
}

}  // namespace placegraph::apps
