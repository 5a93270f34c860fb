#include <placegraph/frontend/labels/field_fitting.h>
#include <placegraph/frontend/labels/model_growth.h>
#include <placegraph/frontend/labels/scene_training.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {

void SceneTrainingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneTrainingOptions& o) {
  field.group("forest", o.forest, "of both rounds");
  field("variants", o.variants, "of each picture: itself, and as another day might show it",
        {1, 50});
  field("class_power", o.class_power, "rare classes weigh as share^-power", {0, 1});
  field("block", o.block, "pictures of a drive one after the other that are alike", {1, 10000});
}

Image fit_labels(const Image& labels, const Image& picture) {
  if (labels.size() == picture.size()) return labels;
  Image fitted;
  cv::resize(labels, fitted, picture.size(), 0, 0, cv::INTER_NEAREST);
  return fitted;
}

SceneExample make_example(const Image& picture, const Image& labels, int classes, int block) {
  require(labels.type() == CV_8UC1 && labels.size() == picture.size(),
          "make_example: labels of another size");
  SceneView view = view_scene(picture);
  SceneExample example;
  example.block = block;
  example.features = std::move(view.features);
  example.superpixels = std::move(view.superpixels);
  const Image& index = example.superpixels.index;
  const Image fitted = fit_labels(labels, index);
  example.pixels.assign(static_cast<std::size_t>(example.superpixels.count * classes), 0);
  for (int v = 0; v < index.rows; ++v)
    for (int u = 0; u < index.cols; ++u) {
      const int label = fitted.at<std::uint8_t>(v, u);
      if (label < classes)
        ++example.pixels[static_cast<std::size_t>(index.at<int>(v, u) * classes + label)];
    }
  example.superpixels.index = Image();
  return example;
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
  SceneLesson lesson = make_lesson(examples, model.class_count(), options.class_power);
  say("learning what superpixels show, from " + std::to_string(lesson.rows.rows()) + " of them");
  TrainedForest first = train_forest(lesson.rows, options.forest, threads);
  add_context(examples, first.unseen, lesson);
  say("learning what lies around them");
  ForestOptions second_options = options.forest;
  ++second_options.seed;
  const TrainedForest second = train_forest(lesson.rows, second_options, threads);
  model.first = std::move(first.forest);
  model.second = second.forest;
  say("learning how classes lie to each other");
  model.relations = learn_relations(examples, lesson);
  fit_field(examples, lesson, second.unseen, model);
  if (base) keep_trees(*base, model);
  return model;
}

}  // namespace placegraph
