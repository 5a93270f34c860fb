#include "apps/train/train_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/scene/label_check.h>
#include <placegraph/frontend/labels/scene_training.h>
#include <placegraph/frontend/labels/scene_variants.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/models/scene_model_file.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "apps/support/labelled_set.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/scene_models.h"
#include "apps/support/usage.h"
#include "apps/train/rendered_streets.h"

namespace placegraph::apps {
namespace {

struct TrainSceneArguments {
  std::string data, out, holdout, update;
  std::vector<std::uint64_t> rendered;
  int rendered_frames = 25, threads = 2, every = 1;
  bool force = false, json = false, ablation = false;
  SceneTrainingOptions options;
};

Image colour_of(const std::string& path) {
  const GreyAndColour read = read_image(path);
  return read.colour.empty() ? read.grey : read.colour;
}

/// A picture to learn from: itself, and its labels as numbers of the model's classes. Photographs
/// are read when they are asked for, rendered ones are kept.
struct LessonPicture {
  std::string sequence;
  std::function<std::pair<Image, Image>()> read;
};

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

/// Photographs of the set, then rendered streets.
std::vector<LessonPicture> make_lesson(const LabelledSet& set,
                                       const std::vector<LabelledPicture>& pictures,
                                       const SceneModel& model, const TrainSceneArguments& a) {
  const bool surfaces = model.kind == SceneModel::Kind::kSurfaces;
  const auto& names = model.classes;
  std::vector<LessonPicture> lesson;
  for (const LabelledPicture& picture : pictures)
    lesson.push_back({picture.sequence, [&set, &names, picture, surfaces] {
                        return std::pair(
                            colour_of(picture.image),
                            read_class_image(picture.labels, set.classes, names, surfaces));
                      }});
  for (const RenderedPicture& picture : render_streets(a.rendered, a.rendered_frames, a.threads))
    lesson.push_back({picture.sequence, [&names, picture, surfaces] {
                        return std::pair(
                            picture.image,
                            class_image(picture.labels, picture.sequence,
                                        SyntheticWorld::scene_classes(), names, surfaces));
                      }});
  return lesson;
}

/// Which of them are alike: so many of a drive one after the other (`block`), and never of two
/// sequences.
std::vector<int> blocks_of(const std::vector<LessonPicture>& lesson, const TrainSceneArguments& a) {
  std::vector<int> block;
  int in_block = 0;
  for (std::size_t i = 0; i < lesson.size(); ++i) {
    const bool same = i > 0 && lesson[i].sequence == lesson[i - 1].sequence;
    const bool full = ++in_block > std::max(1, a.options.block / a.every);
    if (!same || full) in_block = 1;
    block.push_back(i == 0 ? 0 : block.back() + (!same || full ? 1 : 0));
  }
  return block;
}

/// Cuts up every picture as often as there are variants; those of one variant follow each other.
std::vector<SceneExample> make_examples(const std::vector<LessonPicture>& lesson,
                                        const SceneModel& model, const TrainSceneArguments& a) {
  const int count = static_cast<int>(lesson.size()), variants = a.options.variants;
  const std::vector<int> block = blocks_of(lesson, a);
  std::vector<SceneExample> examples(static_cast<std::size_t>(count * variants));
  Progress progress("looking", count * variants, "pictures");
  constexpr int kPart = 16;  // between two lines of progress
  for (int begin = 0; begin < count * variants; begin += kPart) {
    parallel_for(std::min(kPart, count * variants - begin), a.threads, [&](int k) {
      const auto at = static_cast<std::size_t>(begin + k), which = at % lesson.size();
      const std::size_t variant = at / lesson.size();
      const auto [picture, classes] = lesson[which].read();
      Image bgr = scene_picture(picture);
      Image labels = fit_labels(classes, bgr);
      if (variant > 0) {
        Random random(a.options.forest.seed, at);
        SceneVariant drawn = vary_scene(bgr, labels, 255, variant % 2 == 1, random);
        bgr = drawn.bgr, labels = drawn.labels;
      }
      examples[at] = make_example(bgr, labels, model.class_count(), block[which]);
    });
    progress.update(std::min(begin + kPart, count * variants));
  }
  return examples;
}

LabelCheck judge(const SceneModel& model, const LabelledSet& set,
                 const std::vector<LabelledPicture>& pictures, int threads,
                 const LabellerOptions& options = {}) {
  const int classes = model.class_count();
  std::vector<SceneLabels> found(pictures.size());
  std::vector<Image> truth(pictures.size());
  parallel_for(static_cast<int>(pictures.size()), threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    const SceneView view = view_scene(colour_of(pictures[at].image));
    found[at] = most_probable(classify_superpixels(model, view, options), classes, view);
    truth[at] = read_class_image(pictures[at].labels, set.classes, model.classes,
                                 model.kind == SceneModel::Kind::kSurfaces);
  });
  LabelCheck check(classes);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    check.add(truth[i], found[i].labels, found[i].confidence);
  return check;
}

std::string figures(const LabelCheck& check) {
  return fmt::format(
      "pixel accuracy {:.4f}, class accuracy {:.4f}, mean IoU {:.4f}, calibration error {:.4f}",
      check.pixel_accuracy(), check.class_accuracy(), check.mean_iou(), check.calibration_error());
}

nlohmann::json json_of(const LabelCheck& check, const SceneModel& model) {
  nlohmann::json report = {{"pixel_accuracy", check.pixel_accuracy()},
                           {"class_accuracy", check.class_accuracy()},
                           {"mean_iou", check.mean_iou()},
                           {"calibration_error", check.calibration_error()}};
  for (int c = 0; c < model.class_count(); ++c)
    if (!std::isnan(check.iou(c)))
      report["iou"][model.classes[static_cast<std::size_t>(c)]] = check.iou(c);
  return report;
}

/// What each part brings, a part more a line.
nlohmann::json ablation(const SceneModel& model, const LabelledSet& set,
                        const std::vector<LabelledPicture>& pictures,
                        const TrainSceneArguments& a) {
  struct Step {
    const char* name;
    LabellerOptions options;
  };
  nlohmann::json rows;
  for (const Step& step : {Step{"superpixels alone", {false, false, false, 1}},
                           Step{"with context", {true, false, false, 1}},
                           Step{"with two rounds of it", {true, false, false, 2}},
                           Step{"with the random field", {true, true, false, 2}},
                           Step{"with its relations", {true, true, true, 2}}}) {
    const LabelCheck check = judge(model, set, pictures, a.threads, step.options);
    if (!a.json) fmt::print("  {}: {}\n", step.name, figures(check));
    rows[step.name] = json_of(check, model);
  }
  return rows;
}

std::string origin_of(const TrainSceneArguments& a, std::size_t pictures, const SceneModel* base) {
  std::string origin =
      fmt::format("{} pictures, {} variants, {} trees, seed {}", pictures, a.options.variants,
                  a.options.forest.trees, a.options.forest.seed);
  if (!a.holdout.empty()) origin += ", without " + a.holdout;
  if (!a.rendered.empty())
    origin += fmt::format("; beside them {} views of rendered streets of seeds {}",
                          a.rendered.size() * static_cast<std::size_t>(a.rendered_frames),
                          fmt::join(a.rendered, ","));
  return base ? base->origin + "; then " + origin : origin;
}

/// What the classes of an old model lose by new data, on the pictures held out.
void print_losses(const LabelCheck& before, const LabelCheck& after, const SceneModel& base) {
  for (int c = 0; c < base.class_count(); ++c)
    if (!std::isnan(before.accuracy(c)))
      fmt::print("  {}: {:.4f} of its pixels found before, {:.4f} now\n",
                 base.classes[static_cast<std::size_t>(c)], before.accuracy(c), after.accuracy(c));
}

void write_card(const TrainSceneArguments& a, const SceneModel& model, const std::string& result) {
  std::string classes;
  for (const std::string& name : model.classes) classes += " " + name;
  const std::string rendered = a.rendered.empty()
                                   ? ""
                                   : fmt::format(" --rendered {} --rendered-frames {}",
                                                 fmt::join(a.rendered, ","), a.rendered_frames);
  write_file(a.out + ".md",
             fmt::format("# {}\n\nData: {}.\nClasses:{}.\nHeld out: {}.\n\n    placegraph train {} "
                         "DATA --out MODEL{}{}\n",
                         name_of(model.kind), model.origin, classes, result, name_of(model.kind),
                         a.holdout.empty() ? "" : " --holdout " + a.holdout,
                         rendered + fmt::format(" --variants {} --trees {}", a.options.variants,
                                                a.options.forest.trees)));
}

void train(const TrainSceneArguments& a, SceneModel::Kind kind) {
  require_free(a.out, a.force);
  cv::setNumThreads(1);
  LabelledSet set = read_labelled_set(a.data);
  std::vector<LabelledPicture> learned, held;
  for (std::size_t i = 0; i < set.train.size(); ++i) {
    if (!a.holdout.empty() && set.train[i].sequence == a.holdout)
      held.push_back(set.train[i]);
    else if (i % static_cast<std::size_t>(a.every) == 0)
      learned.push_back(set.train[i]);
  }
  require(a.holdout.empty() || !held.empty(),
          "--holdout: no picture is of the sequence " + a.holdout);
  require(!learned.empty(), "--holdout: nothing is left to learn from");
  if (a.holdout.empty()) held = set.val;
  std::optional<SceneModel> base;
  if (!a.update.empty()) base = load_scene_model(kind, a.update);
  SceneModel model = blank_model(kind, set.classes, base ? &*base : nullptr);
  model.origin = origin_of(a, learned.size(), base ? &*base : nullptr);
  const Stopwatch watch;
  const std::vector<LessonPicture> lesson = make_lesson(set, learned, model, a);
  std::vector<SceneExample> examples = make_examples(lesson, model, a);
  model = train_scene_model(
      std::move(model), std::move(examples), a.options, a.threads,
      [](const std::string& doing) { fmt::print(stderr, "{}\n", doing); }, base ? &*base : nullptr);
  write_scene_model(a.out, model);
  std::string result = "nothing";
  nlohmann::json report = {
      {"out", a.out}, {"pictures", lesson.size()}, {"seconds", watch.wall_ms() / 1e3}};
  if (!a.json)
    fmt::print(
        "{}: learned from {} pictures in {:.0f} s; smoothness {}, relations {}, sharpness {}\n",
        a.out, lesson.size(), watch.wall_ms() / 1e3, model.smoothness, model.relation_weight,
        model.sharpness);
  if (!held.empty()) {
    const LabelCheck check = judge(model, set, held, a.threads);
    result = fmt::format("{} pictures of {}: {}", held.size(),
                         a.holdout.empty() ? "val" : a.holdout, figures(check));
    report["held_out"] = json_of(check, model);
    if (!a.json) fmt::print("{}\n", result);
    if (a.ablation) report["ablation"] = ablation(model, set, held, a);
    if (base && !a.json) print_losses(judge(*base, set, held, a.threads), check, *base);
  }
  write_card(a, model, result);
  if (a.json) fmt::print("{}\n", report.dump(2));
}

}  // namespace

void add_train_scene_command(CLI::App& train_command, SceneModel::Kind kind, const char* about) {
  const std::string name = name_of(kind);
  CLI::App* command = train_command.add_subcommand(name, about);
  command->footer("placegraph train " + name + " camvid --out " + name +
                  ".pgscene --holdout 0001TP");
  auto arguments = std::make_shared<TrainSceneArguments>();
  TrainSceneArguments& a = *arguments;
  command
      ->add_option(
          "DATA", a.data,
          "folder with CLASSES.txt and train/ of images/ and labels/, val/ beside it judges")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write the model, and its card beside it")->required();
  command->add_option("--holdout", a.holdout,
                      "a sequence (names up to the first '_') that judges instead of teaching");
  command->add_option("--update", a.update,
                      "a model to add these data to, with classes it does not know yet");
  command
      ->add_option("--variants", a.options.variants,
                   "of each picture, as another day might show it")
      ->capture_default_str();
  command->add_option("--trees", a.options.forest.trees, "of each forest")->capture_default_str();
  command->add_option("--min-leaf", a.options.forest.min_leaf, "superpixels a leaf holds at least")
      ->capture_default_str();
  command->add_option("--tries", a.options.forest.tries, "features looked at for a split")
      ->capture_default_str();
  command
      ->add_option("--share-rows", a.options.forest.share_rows,
                   "of the superpixels, taken by a tree")
      ->capture_default_str();
  command->add_option("--class-power", a.options.class_power, "rare classes weigh as share^-power")
      ->capture_default_str();
  command
      ->add_option("--rendered", a.rendered,
                   "seeds of rendered towns to learn from too, joined by commas, whose classes are "
                   "known exactly; those of even seeds have traffic and bad light")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--rendered-frames", a.rendered_frames, "views of each")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--every", a.every, "learn from every n-th photograph only")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", a.options.forest.seed, "of what is drawn")->capture_default_str();
  command->add_option("--threads", a.threads, "do not change the result")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_flag("--ablation", a.ablation, "judge each part of the model too");
  command->add_flag("--json", a.json, "a report for machines");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments, kind] { train(*arguments, kind); });
}

}  // namespace placegraph::apps
