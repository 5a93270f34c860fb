#pragma once
#include <placegraph/frontend/internal/labels/forest_training.h>
#include <placegraph/frontend/internal/labels/scene_labeller.h>

#include <vector>

namespace placegraph {

/// A picture to learn from, cut up: its features, and which classes the pixels of each superpixel
/// have.
struct SceneExample {
  Superpixels superpixels;  ///< without the index
  ByteFeatures features;
  std::vector<int> pixels;  ///< count x classes; void ones in none
  int block = 0;            ///< examples of one are alike
};

/// Labels at the size of a picture, by their nearest pixels.
Image fit_labels(const Image& labels, const Image& picture);

/// `labels` CV_8UC1 of the picture's size, void from `classes` on. Throws ArgumentError if the
/// sizes do not agree.
SceneExample make_example(const Image& picture, const Image& labels, int classes, int block);

/// Whether the random field's weights are chosen by this example of so many: some hundred are
/// enough.
[[nodiscard]] bool judges_field(std::size_t example, std::size_t examples);

/// What the superpixels of all examples teach, one row each, example by example.
struct SceneTrainingSet {
  ForestTrainingSet rows;
  std::vector<int> first_row;  ///< of each example

  int classes() const { return rows.classes; }
  /// Of the first superpixel of an example, in an array of rows x classes.
  std::size_t first_share(std::size_t example) const {
    return static_cast<std::size_t>(first_row[example]) * static_cast<std::size_t>(classes());
  }
};

/// A row's label is the class that half of its superpixel's pixels or more have, else void; it
/// weighs as many pixels as have it, rare classes more, as their share to the power -class_power.
/// Features are kept feature by feature: those of examples that do not judge the random field
/// (judges_field) are let go of. Throws ArgumentError if no pixel is labelled.
[[nodiscard]] SceneTrainingSet make_training_set(std::vector<SceneExample>& examples, int classes,
                                                 double class_power);

/// Adds to every row what lies around its superpixel. `shares`: of the classes, rows x classes.
void add_context(const std::vector<SceneExample>& examples, const std::vector<float>& shares,
                 SceneTrainingSet& training_set);

}  // namespace placegraph
