#pragma once
#include <placegraph/frontend/labels/scene_training_set.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/scene_model.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph {

struct SceneTrainingOptions {
  ForestOptions forest;  ///< options of both forests
  /// Number of variants of each image: itself, and simulations of other conditions.
  int variants = 3;
  double class_power = 0.5;  ///< exponent of the weight share^-power of rare classes
  int block = 15;            ///< number of consecutive images of a drive that count as similar
  void check() const;
};
void visit(OptionVisitor& field, SceneTrainingOptions& options);

/// Trains a model of the given classes.
///
/// `kind`, `classes`, `surfaces` and `origin` are taken from `model`. `base`: model whose trees are
/// kept beside the new ones; its classes, with the same names, come first in `model`. The result
/// has the same bits for any number of threads. `say` receives messages on the progress. Throws
/// ArgumentError if there are no training data.
SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base = nullptr);

}  // namespace placegraph
