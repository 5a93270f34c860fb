#include "apps/map/cmd_localize.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/map/map_localizer.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "apps/map/map_learn.h"
#include "apps/results/map_file.h"
#include "apps/support/json_file.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

struct LocalizeArguments {
  std::string map, images, out;
  std::vector<int> range;
  std::vector<std::string> settings;
  bool sequence = false, as_json = false, force = false;
};

/// Views are compared by the cues they were described with, features as the run did.
LocalizerOptions options_of(const LocalizeArguments& arguments, const StoredMap& stored,
                            const std::string& path) {
  LocalizerOptions options;
  if (stored.origin.view_options.empty())
    throw NoAnswer(path + ": holds no views of its keyframes (run with views.enabled)");
  read_options_text(path, stored.origin.view_options, options.recognizer.cues);
  if (!stored.origin.options.empty()) {
    RunOptions run;
    read_options_text(path, stored.origin.options, run);
    options.loops = run.slam.loops;
  }
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  options.check();
  return options;
}

std::string line_of(std::int64_t image, const Localization& at) {
  std::string line =
      fmt::format("{} {} {} {:.6f} {}", image, at.placed ? at.place : -1, at.placed ? at.frame : -1,
                  at.probability, at.placed ? at.stage : "refused:" + at.stage);
  if (at.T_map_cam) {
    const auto& t = at.T_map_cam->translation();
    const auto& q = at.T_map_cam->rotation().quaternion();
    line += fmt::format(" {:.6f} {:.6f} {:.6f} {:.9f} {:.9f} {:.9f} {:.9f}", t.x(), t.y(), t.z(),
                        q.x(), q.y(), q.z(), q.w());
  }
  return line + "\n";
}

json json_of(std::int64_t image, const Localization& at) {
  json entry = {{"image", image},   {"placed", at.placed},     {"place", at.place},
                {"view", at.frame}, {"keyframe", at.keyframe}, {"probability", at.probability},
                {"stage", at.stage}};
  if (at.T_map_cam) entry["T_map_cam"] = pose_json(*at.T_map_cam);
  return entry;
}

/// Images of the map's camera come as its data set hands them over (undistorted), others as files.
MapLocalizer::Frames frames_of(const ImageRange& images, std::shared_ptr<Dataset> dataset) {
  if (!dataset) return [images](std::size_t i) { return read_frame(images, i); };
  const Sensor sensor = dataset->sensors().front();
  return [dataset, sensor, first = images.first](std::size_t i) {
    return dataset->frame(static_cast<std::size_t>(first) + i, sensor);
  };
}

std::shared_ptr<Dataset> dataset_of(const std::string& path, std::size_t images) {
  try {
    std::shared_ptr<Dataset> dataset = open_dataset(path);
    return dataset->size() >= images ? dataset : nullptr;
  } catch (const Error&) {
    return nullptr;  // a folder of images without a camera
  }
}

void run(const LocalizeArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const std::string path = map_path_of(arguments.map);
  StoredMap stored = read_stored_map(arguments.map);
  const LocalizerOptions options = options_of(arguments, stored, path);
  const ImageRange images = images_of(arguments.images, arguments.range);
  const auto dataset =
      stored.origin.calibration
          ? dataset_of(arguments.images,
                       images.paths.size() + static_cast<std::size_t>(images.first))
          : nullptr;
  const auto frames = frames_of(images, dataset);
  cv::setNumThreads(1);
  const MapLocalizer localizer(options, std::move(stored));
  if (dataset == nullptr && localizer.has_geometry(read_frame(images, 0).image))
    warn(arguments.images + ": no camera is given; taken for the map's");
  const Stopwatch watch;
  Progress progress("placing", static_cast<std::int64_t>(images.paths.size()), "images");
  const auto answers = localizer.localize(
      images.paths.size(),
      [&](std::size_t i) {
        progress.update(static_cast<std::int64_t>(i) + 1);
        return frames(i);
      },
      arguments.sequence);
  std::string text;
  json list = json::array();
  std::size_t placed = 0, posed = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::int64_t image = images.first + static_cast<std::int64_t>(i);
    text += line_of(image, answers[i]);
    list.push_back(json_of(image, answers[i]));
    placed += answers[i].placed;
    posed += answers[i].T_map_cam.has_value();
  }
  write_file(arguments.out, arguments.as_json ? json{{"images", list}}.dump(1) + "\n" : text);
  const double ms = watch.cpu_ms() / static_cast<double>(answers.size());
  if (arguments.as_json)
    fmt::print("{}\n", json{{"images", answers.size()},
                            {"placed", placed},
                            {"posed", posed},
                            {"refused", answers.size() - placed},
                            {"cpu_ms_an_image", ms}}
                           .dump(1));
  else
    fmt::print(
        "{} images, {} placed ({} with a pose), {} refused, {:.1f} ms CPU an image, written "
        "to {}\n",
        answers.size(), placed, posed, answers.size() - placed, ms, arguments.out);
  if (placed == 0) throw NoAnswer(arguments.images + ": none of the images could be placed");
}

}  // namespace

void add_localize_command(CLI::App& app) {
  auto arguments = std::make_shared<LocalizeArguments>();
  LocalizeArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("localize", "Place new images in a saved map.");
  command->footer("placegraph localize out/town images --out placed.txt --sequence");
  command->add_option("MAP", a.map, "map.db, or the folder of placegraph run with it")->required();
  command->add_option("IMAGES", a.images, "a folder of images, or a sequence")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--out", a.out,
                   "write `image place view probability stage [pose]`, one line an image")
      ->required();
  command->add_option("--range", a.range, "first and last image")->expected(2);
  command->add_flag("--sequence", a.sequence,
                    "the images follow each other: add the evidence of those before and after");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "write and print JSON");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
