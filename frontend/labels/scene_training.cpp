#include <placegraph/frontend/labels/field_fitting.h>
#include <placegraph/frontend/labels/model_growth.h>
#include <placegraph/frontend/labels/scene_training.h>
#include <placegraph/graph/core/error.h>

#include <utility>

namespace placegraph {

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

SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base) {
  options.check();
  require(model.class_count() >= 2 && !examples.empty(), "train_scene_model: no training data");
  for (const SceneExample& example : examples)
    require(example.pixels.size() ==
                static_cast<std::size_t>(example.superpixels.count) * model.classes.size(),
            "train_scene_model: an example has other classes");
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
