#pragma once
#include <placegraph/frontend/labels/scene_training.h>

#include <vector>

namespace placegraph {

/// What the superpixels of all examples teach, one row each, example by example.
struct SceneLesson {
  ForestLesson rows;
  std::vector<int> first_row;  ///< of each example

  int classes() const { return rows.classes; }
  /// Of the first superpixel of an example, in an array of rows x classes.
  std::size_t first_share(std::size_t example) const {
    return static_cast<std::size_t>(first_row[example]) * static_cast<std::size_t>(classes());
  }
};

/// A row's label is the class that half of its superpixel's pixels or more have, else void; it
/// weighs as many pixels as have it, rare classes more (SceneTrainingOptions::class_power).
/// Features are kept feature by feature: those of examples that do not judge the random field
/// (judges_field) are let go of. Throws ArgumentError if no pixel is labelled.
[[nodiscard]] SceneLesson make_lesson(std::vector<SceneExample>& examples, int classes,
                                      double class_power);

/// Adds to every row what lies around its superpixel. `shares`: of the classes, rows x classes.
void add_context(const std::vector<SceneExample>& examples, const std::vector<float>& shares,
                 SceneLesson& lesson);

}  // namespace placegraph
