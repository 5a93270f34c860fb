#pragma once
#include <placegraph/frontend/internal/labels/scene_training_set.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/scene_model.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph {

struct SceneTrainingOptions {
  ForestOptions forest;      ///< of both rounds
  int variants = 3;          ///< of each picture: itself, and as another day might show it
  double class_power = 0.5;  ///< rare classes weigh as share^-power
  int block = 15;            ///< pictures of a drive one after the other that are alike
  void check() const;
};
void visit(OptionVisitor& field, SceneTrainingOptions& options);

/// Learns a model of the classes in it (`kind`, `classes`, `surfaces` and `origin` are taken from
/// `model`); `base`: one whose trees are kept beside the new ones, classes of the same names
/// first in `model`. The same bits for any number of threads. `say` hears what is being done.
/// Throws ArgumentError if there is nothing to learn from.
SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base = nullptr);

}  // namespace placegraph
