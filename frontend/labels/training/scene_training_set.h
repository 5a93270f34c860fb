#pragma once
#include <placegraph/frontend/labels/training/forest_training.h>
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/frontend/labels/training/scene_training.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace placegraph {

/// Training image in superpixels: features, and the number of pixels of each class.
struct SceneExample {
  Superpixels superpixels;  ///< without the index
  ByteFeatures features;
  std::vector<int> pixels;  ///< count x classes; void pixels do not count
  int block = 0;            ///< examples of one block are similar
};

/// Resizes labels to the size of an image, by their nearest pixels.
Image fit_labels(const Image& labels, const Image& picture);

/// Makes an example. `labels`: CV_8UC1 of the image's size, void from `classes` on. Throws
/// ArgumentError if the sizes do not agree.
SceneExample make_example(const Image& picture, const Image& labels, int classes, int block);

/// Divides every image into superpixels, once per variant; variants are consecutive blocks.
///
/// Up to `options.block` consecutive images of one sequence have the same number of a block.
/// `described` receives the number of examples made so far, unless it is empty.
std::vector<SceneExample> make_examples(const std::vector<SceneTrainingImage>& images, int classes,
                                        const SceneTrainingOptions& options, int threads,
                                        const std::function<void(std::size_t)>& described = {});

/// Whether an example, out of so many, is used to choose the random field's weights: some hundred
/// are enough.
[[nodiscard]] bool judges_field(std::size_t example, std::size_t examples);

/// Training rows of the superpixels of all examples, one each, example by example.
struct SceneTrainingSet {
  ForestTrainingSet rows;
  std::vector<int> first_row;  ///< first row of each example

  int classes() const { return rows.classes; }
  /// Index of the first superpixel of an example in an array of rows x classes.
  std::size_t first_share(std::size_t example) const {
    return static_cast<std::size_t>(first_row[example]) * static_cast<std::size_t>(classes());
  }
};

/// Makes the training set and clears features of the examples.
///
/// A row's label is the class of at least half of its superpixel's pixels, else void. Its weight is
/// the number of pixels of the class, multiplied by the class's share to the power -class_power,
/// which is more for rare classes. Features are stored feature by feature; those of examples that
/// are not used for the random field (judges_field) are freed. Throws ArgumentError if no pixel is
/// labelled.
[[nodiscard]] SceneTrainingSet make_training_set(std::vector<SceneExample>& examples, int classes,
                                                 double class_power);

/// Adds features of the surroundings to every row. `shares`: of the classes, rows x classes.
void add_context(const std::vector<SceneExample>& examples, const std::vector<float>& shares,
                 SceneTrainingSet& training_set);

}  // namespace placegraph
