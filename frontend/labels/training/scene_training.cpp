#include <placegraph/frontend/labels/training/field_fitting.h>
#include <placegraph/frontend/labels/training/model_growth.h>
#include <placegraph/frontend/labels/training/scene_training.h>
#include <placegraph/frontend/labels/training/scene_training_set.h>
#include <placegraph/frontend/labels/training/scene_variants.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <utility>

namespace placegraph {

void ForestOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, ForestOptions& o) {
  field("trees", o.trees, "number of trees", {1, 1000});
  field("max_depth", o.max_depth, "maximum depth of a tree", {1, 40});
  field("min_leaf", o.min_leaf, "minimum number of rows of a leaf", {1, 1e6});
  field("tries", o.tries, "number of features tried for a split", {1, 60000});
  field("share_blocks", o.share_blocks, "share of the blocks that a tree uses", {0.01, 1});
  field("share_rows", o.share_rows, "share of the rows of its blocks that a tree uses", {0.001, 1});
  field("seed", o.seed, "seed of the random samples");
}

void SceneTrainingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneTrainingOptions& o) {
  field.group("forest", o.forest, "options of both forests");
  field("variants", o.variants,
        "number of variants of each image: itself, and simulations of other conditions", {1, 50});
  field("class_power", o.class_power, "exponent of the weight share^-power of rare classes",
        {0, 1});
  field("block", o.block, "number of consecutive images of a drive that count as similar",
        {1, 10000});
}

SceneModel train_scene_model(SceneModel model, const std::vector<SceneTrainingImage>& images,
                             const SceneTrainingOptions& options, int threads,
                             const SceneTrainingProgress& progress, const SceneModel* base) {
  options.check();
  require(model.class_count() >= 2 && !images.empty(), "train_scene_model: no training data");
  const auto say = [&](const std::string& doing) {
    if (progress.doing) progress.doing(doing);
  };
  std::vector<SceneExample> examples =
      make_examples(images, model.class_count(), options, threads, progress.described);
  SceneTrainingSet training_set =
      make_training_set(examples, model.class_count(), options.class_power);
  say("training the first forest from " + std::to_string(training_set.rows.rows()) +
      " superpixels");
  TrainedForest first = train_forest(training_set.rows, options.forest, threads);
  add_context(examples, first.unseen, training_set);
  say("training the second forest, with the context of the superpixels");
  ForestOptions second_options = options.forest;
  ++second_options.seed;
  const TrainedForest second = train_forest(training_set.rows, second_options, threads);
  model.first = std::move(first.forest);
  model.second = second.forest;
  say("fitting the random field");
  model.relations = learn_relations(examples, training_set);
  fit_field(examples, training_set, second.unseen, model);
  if (base) keep_trees(*base, model);
  return model;
}

}  // namespace placegraph
