#include "apps/train/training_images.h"

#include <placegraph/frontend/labels/scene_variants.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <algorithm>

#include "apps/support/progress.h"
#include "apps/train/rendered_streets.h"

namespace placegraph::apps {
namespace {

/// Block of each image: up to `block` consecutive images of one sequence, which are similar.
std::vector<int> blocks_of(const std::vector<TrainingImage>& training_set,
                           const TrainingImageOptions& a) {
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

std::vector<TrainingImage> training_images(const LabelledSet& set,
                                           const std::vector<LabelledImage>& images,
                                           const SceneModel& model, const TrainingImageOptions& a) {
  const bool surfaces = model.kind == SceneModel::Kind::kSurfaces;
  const auto& names = model.classes;
  std::vector<TrainingImage> training_set;
  for (const LabelledImage& image : images)
    training_set.push_back({image.sequence, [&set, &names, image, surfaces] {
                              return std::pair(
                                  colour_of(image.image),
                                  read_class_image(image.labels, set.classes, names, surfaces));
                            }});
  for (const RenderedImage& image : render_streets(a.rendered, a.rendered_frames, a.threads))
    training_set.push_back({image.sequence, [&names, image, surfaces] {
                              return std::pair(
                                  image.image,
                                  class_image(image.labels, image.sequence,
                                              SyntheticWorld::scene_classes(), names, surfaces));
                            }});
  return training_set;
}

std::vector<SceneExample> make_examples(const std::vector<TrainingImage>& training_set,
                                        const SceneModel& model, const TrainingImageOptions& a) {
  const int count = static_cast<int>(training_set.size()), variants = a.training.variants;
  const std::vector<int> block = blocks_of(training_set, a);
  std::vector<SceneExample> examples(static_cast<std::size_t>(count * variants));
  Progress progress("describing", count * variants, "images");
  constexpr int kPart = 16;  // images between two updates of the progress
  for (int begin = 0; begin < count * variants; begin += kPart) {
    parallel_for(std::min(kPart, count * variants - begin), a.threads, [&](int k) {
      const auto at = static_cast<std::size_t>(begin + k), which = at % training_set.size();
      const std::size_t variant = at / training_set.size();
      const auto [image, classes] = training_set[which].read();
      Image bgr = scene_picture(image);
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
