#include <placegraph/frontend/internal/labels/field_fitting.h>
#include <placegraph/frontend/internal/labels/model_growth.h>
#include <placegraph/frontend/internal/labels/scene_training.h>
#include <placegraph/graph/core/error.h>

#include <utility>

namespace placegraph {

void SceneTrainingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneTrainingOptions& o) {
  field.group("forest", o.forest, "of both rounds");
  field("variants", o.variants, "of each picture: itself, and as another day might show it",
        {1, 50});
  field("class_power", o.class_power, "rare classes weigh as share^-power", {0, 1});
  field("block", o.block, "pictures of a drive one after the other that are alike", {1, 10000});
}

SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base) {
  options.check();
  require(model.class_count() >= 2 && !examples.empty(),
          "train_scene_model: nothing to learn from");
  for (const SceneExample& example : examples)
    require(example.pixels.size() ==
                static_cast<std::size_t>(example.superpixels.count) * model.classes.size(),
            "train_scene_model: an example of other classes");
  SceneTrainingSet training_set =
      make_training_set(examples, model.class_count(), options.class_power);
  say("learning what superpixels show, from " + std::to_string(training_set.rows.rows()) +
      " of them");
  TrainedForest first = train_forest(training_set.rows, options.forest, threads);
  add_context(examples, first.unseen, training_set);
  say("learning what lies around them");
  ForestOptions second_options = options.forest;
  ++second_options.seed;
  const TrainedForest second = train_forest(training_set.rows, second_options, threads);
  model.first = std::move(first.forest);
  model.second = second.forest;
  say("learning how classes lie to each other");
  model.relations = learn_relations(examples, training_set);
  fit_field(examples, training_set, second.unseen, model);
  if (base) keep_trees(*base, model);
  return model;
}

}  // namespace placegraph
