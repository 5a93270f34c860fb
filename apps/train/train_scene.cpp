#include "apps/train/train_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/frontend/labels/scene_labels.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/models/scene_model_file.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "apps/shipped/scene_models.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

/// The classes of the model: those of `base` first, then new ones of the set.
SceneModel blank_model(SceneModel::Kind kind, const std::vector<SceneClass>& classes,
                       const SceneModel* base) {
  SceneModel model;
  model.kind = kind;
  if (base) model.classes = base->classes, model.surfaces = base->surfaces;
  const auto add = [&](const std::string& name, Surface surface) {
    if (std::find(model.classes.begin(), model.classes.end(), name) != model.classes.end()) return;
    model.classes.push_back(name);
    model.surfaces.push_back(surface);
  };
  if (kind == SceneModel::Kind::kSurfaces)
    for (int s = 0; s < kSurfaceCount; ++s)
      add(surface_name(static_cast<Surface>(s)), static_cast<Surface>(s));
  else
    for (const SceneClass& c : classes)
      if (c.surface) add(c.name, *c.surface);
  return model;
}

LabelCheck judge_scenes(const SceneModel& model, const LabelledSet& set,
                        const std::vector<LabelledImage>& images, int threads,
                        const LabellerOptions& options = {}) {
  const int classes = model.class_count();
  std::vector<SceneLabels> found(images.size());
  std::vector<Image> truth(images.size());
  parallel_for(static_cast<int>(images.size()), threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    found[at] = label_scene(model, colour_of(images[at].image), 0, options);
    truth[at] = read_class_image(images[at].labels, set.classes, model.classes,
                                 model.kind == SceneModel::Kind::kSurfaces);
  });
  LabelCheck check(classes);
  for (std::size_t i = 0; i < images.size(); ++i)
    check.add(truth[i], found[i].labels, found[i].confidence);
  return check;
}

std::string figures(const LabelCheck& check) {
  return fmt::format(
      "pixel accuracy {:.4f}, class accuracy {:.4f}, mean IoU {:.4f}, calibration error {:.4f}",
      check.pixel_accuracy(), check.class_accuracy(), check.mean_iou(), check.calibration_error());
}

nlohmann::json json_of(const LabelCheck& check, const std::vector<std::string>& classes) {
  nlohmann::json report = {{"pixel_accuracy", check.pixel_accuracy()},
                           {"class_accuracy", check.class_accuracy()},
                           {"mean_iou", check.mean_iou()},
                           {"calibration_error", check.calibration_error()}};
  for (int c = 0; c < check.classes(); ++c)
    if (!std::isnan(check.iou(c)))
      report["iou"][classes[static_cast<std::size_t>(c)]] = check.iou(c);
  return report;
}

/// Evaluates the model with one more part each time.
std::vector<SceneAblation> ablation(const SceneModel& model, const LabelledSet& set,
                                    const std::vector<LabelledImage>& images, int threads) {
  struct Step {
    const char* name;
    LabellerOptions options;
  };
  std::vector<SceneAblation> rows;
  for (const Step& step : {Step{"superpixels alone", {false, false, false, 1}},
                           Step{"with context", {true, false, false, 1}},
                           Step{"with two rounds of it", {true, false, false, 2}},
                           Step{"with the random field", {true, true, false, 2}},
                           Step{"with its relations", {true, true, true, 2}}})
    rows.push_back({step.name, judge_scenes(model, set, images, threads, step.options)});
  return rows;
}

std::string origin_of(const TrainSceneArguments& a, std::size_t images, const SceneModel* base) {
  std::string origin = fmt::format("{} pictures, {} variants, {} trees, seed {}", images,
                                   a.options.training.variants, a.options.training.forest.trees,
                                   a.options.training.forest.seed);
  if (!a.holdout.empty()) origin += ", without " + a.holdout;
  if (!a.options.rendered.empty())
    origin +=
        fmt::format("; beside them {} views of rendered streets of seeds {}",
                    a.options.rendered.size() * static_cast<std::size_t>(a.options.rendered_frames),
                    fmt::join(a.options.rendered, ","));
  return base ? base->origin + "; then " + origin : origin;
}

/// Changes of the classes of the old model on the test set.
std::vector<SceneClassChange> changes_of(const LabelCheck& before, const LabelCheck& after,
                                         const SceneModel& base) {
  std::vector<SceneClassChange> changes;
  for (int c = 0; c < base.class_count(); ++c)
    if (!std::isnan(before.accuracy(c)))
      changes.push_back(
          {base.classes[static_cast<std::size_t>(c)], before.accuracy(c), after.accuracy(c)});
  return changes;
}

std::string headline(const SceneJudgement& held) {
  return fmt::format("{} images of {}: {}", held.images, held.sequence, figures(held.check));
}

void write_card(const TrainSceneArguments& a, const SceneModel& model, const std::string& result) {
  std::string classes;
  for (const std::string& name : model.classes) classes += " " + name;
  const std::string rendered =
      a.options.rendered.empty()
          ? ""
          : fmt::format(" --rendered {} --rendered-frames {}", fmt::join(a.options.rendered, ","),
                        a.options.rendered_frames);
  write_file(
      a.out + ".md",
      fmt::format("# {}\n\nData: {}.\nClasses:{}.\nHeld out: {}.\n\n    placegraph train {} "
                  "DATA --out MODEL{}{}\n",
                  name_of(model.kind), model.origin, classes, result, name_of(model.kind),
                  a.holdout.empty() ? "" : " --holdout " + a.holdout,
                  rendered + fmt::format(" --variants {} --trees {}", a.options.training.variants,
                                         a.options.training.forest.trees)));
}

/// The images of the training set and of the test set.
struct SplitImages {
  std::vector<LabelledImage> learned, held;
};

SplitImages split(const LabelledSet& set, const TrainSceneArguments& a) {
  SplitImages split;
  for (std::size_t i = 0; i < set.train.size(); ++i) {
    if (!a.holdout.empty() && set.train[i].sequence == a.holdout)
      split.held.push_back(set.train[i]);
    else if (i % static_cast<std::size_t>(a.options.every) == 0)
      split.learned.push_back(set.train[i]);
  }
  require(a.holdout.empty() || !split.held.empty(),
          "--holdout: no image is of the sequence " + a.holdout);
  require(!split.learned.empty(), "--holdout: the training set is empty");
  if (a.holdout.empty()) split.held = set.val;
  return split;
}

SceneJudgement judgement_of(const TrainSceneArguments& a, const SceneModel& model,
                            const SceneModel* base, const LabelledSet& set,
                            const std::vector<LabelledImage>& held) {
  const int threads = a.options.threads;
  SceneJudgement judged{held.size(),
                        a.holdout.empty() ? "val" : a.holdout,
                        judge_scenes(model, set, held, threads),
                        {},
                        {}};
  if (a.ablation) judged.ablation = ablation(model, set, held, threads);
  if (base)
    judged.changes = changes_of(judge_scenes(*base, set, held, threads), judged.check, *base);
  return judged;
}

}  // namespace

TrainSceneResult train_scene(const TrainSceneArguments& a, SceneModel::Kind kind,
                             const LogSink& sink) {
  require_free(a.out, a.force);
  cv::setNumThreads(1);
  const LabelledSet set = read_labelled_set(a.data);
  const SplitImages images = split(set, a);
  std::optional<SceneModel> base;
  if (!a.update.empty()) base = load_scene_model(kind, a.update);
  const SceneModel* const old = base ? &*base : nullptr;
  SceneModel model = blank_model(kind, set.classes, old);
  model.origin = origin_of(a, images.learned.size(), old);
  const Stopwatch watch;
  const std::vector<SceneTrainingImage> training_set =
      training_images(set, images.learned, model, a.options);
  SceneTrainingOptions options = a.options.training;
  options.block = std::max(1, options.block / a.options.every);
  const std::size_t count = training_set.size() * static_cast<std::size_t>(options.variants);
  std::optional<Progress> described(std::in_place, "describing", static_cast<std::int64_t>(count),
                                    "images");
  SceneTrainingProgress progress;
  progress.described = [&](std::size_t done) {
    described->update(static_cast<std::int64_t>(done));
    if (done == count) described.reset();
  };
  progress.doing = [&](const std::string& doing) {
    if (sink) sink(LogLevel::kInfo, doing);
  };
  model =
      train_scene_model(std::move(model), training_set, options, a.options.threads, progress, old);
  write_scene_model(a.out, model);
  TrainSceneResult result{a.out,
                          training_set.size(),
                          watch.wall_ms() / 1e3,
                          model.classes,
                          model.smoothness,
                          model.relation_weight,
                          model.sharpness,
                          {}};
  if (!images.held.empty()) result.held_out = judgement_of(a, model, old, set, images.held);
  write_card(a, model, result.held_out ? headline(*result.held_out) : "nothing");
  return result;
}

std::string to_text(const TrainSceneResult& result) {
  std::string text = fmt::format(
      "{}: learned from {} images in {:.0f} s; smoothness {}, relations {}, sharpness {}\n",
      result.out, result.images, result.wall_s, result.smoothness, result.relation_weight,
      result.sharpness);
  if (!result.held_out) return text;
  text += headline(*result.held_out) + "\n";
  for (const SceneAblation& step : result.held_out->ablation)
    text += fmt::format("  {}: {}\n", step.parts, figures(step.check));
  for (const SceneClassChange& change : result.held_out->changes)
    text += fmt::format("  {}: {:.4f} of its pixels found before, {:.4f} now\n", change.name,
                        change.before, change.now);
  return text;
}

std::string to_json(const TrainSceneResult& result) {
  nlohmann::json report = {
      {"out", result.out}, {"pictures", result.images}, {"seconds", result.wall_s}};
  if (result.held_out) {
    report["held_out"] = json_of(result.held_out->check, result.classes);
    for (const SceneAblation& step : result.held_out->ablation)
      report["ablation"][step.parts] = json_of(step.check, result.classes);
  }
  return json_text(report, 2);
}

}  // namespace placegraph::apps
