#include "apps/map/cmd_localize.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/map/map_localizer.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "apps/map/query_images.h"
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
  if (!at.without_pose.empty()) entry["without_pose"] = at.without_pose;
  return entry;
}

/// How many images were placed, and what became of the others.
struct Counts {
  std::size_t images = 0, placed = 0, posed = 0;
  std::map<std::string, std::size_t> refused;       ///< by the stage that decided
  std::map<std::string, std::size_t> without_pose;  ///< placed ones, by the reason
};

Counts count(const std::vector<Localization>& answers) {
  Counts counts;
  counts.images = answers.size();
  for (const Localization& answer : answers) {
    counts.placed += answer.placed;
    counts.posed += answer.T_map_cam.has_value();
    if (!answer.placed) ++counts.refused[answer.stage];
    if (!answer.without_pose.empty()) ++counts.without_pose[answer.without_pose];
  }
  return counts;
}

std::string text_of(const Counts& counts) {
  std::string text = fmt::format("{} images, {} placed ({} with a pose", counts.images,
                                 counts.placed, counts.posed);
  for (const auto& [reason, images] : counts.without_pose)
    text += fmt::format("; {} without: {}", images, reason);
  text += fmt::format("), {} refused", counts.images - counts.placed);
  const char* separator = " (";
  for (const auto& [stage, images] : counts.refused) {
    text += fmt::format("{}{} by {}", separator, images, stage);
    separator = ", ";
  }
  return text + (counts.refused.empty() ? "" : ")");
}

json json_of(const Counts& counts, const std::vector<std::string>& notes) {
  return {{"images", counts.images},
          {"placed", counts.placed},
          {"posed", counts.posed},
          {"without_pose", counts.without_pose},
          {"refused", counts.images - counts.placed},
          {"refused_by", counts.refused},
          {"notes", notes}};
}

void run(const LocalizeArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const std::string path = map_path_of(arguments.map);
  StoredMap stored = read_stored_map(arguments.map);
  const LocalizerOptions options = options_of(arguments, stored, path);
  const QueryImages images = query_images(arguments.images, arguments.range, stored.origin);
  for (const std::string& note : images.notes) warn(arguments.images + ": " + note);
  cv::setNumThreads(1);
  const MapLocalizer localizer(options, std::move(stored));
  const Stopwatch watch;
  Progress progress("placing", static_cast<std::int64_t>(images.count), "images");
  const auto answers = localizer.localize(
      images.count,
      [&](std::size_t i) {
        progress.update(static_cast<std::int64_t>(i) + 1);
        return images.frame(i);
      },
      arguments.sequence);
  std::string text;
  json list = json::array();
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const std::int64_t image = images.first + static_cast<std::int64_t>(i);
    text += line_of(image, answers[i]);
    list.push_back(json_of(image, answers[i]));
  }
  write_file(arguments.out, arguments.as_json ? json{{"images", list}}.dump(1) + "\n" : text);
  const Counts counts = count(answers);
  const double ms = watch.cpu_ms() / static_cast<double>(answers.size());
  if (arguments.as_json) {
    json summary = json_of(counts, images.notes);
    summary["cpu_ms_an_image"] = ms;
    fmt::print("{}\n", summary.dump(1));
  } else {
    fmt::print("{}, {:.1f} ms CPU an image, written to {}\n", text_of(counts), ms, arguments.out);
  }
  if (counts.placed == 0) throw NoAnswer(arguments.images + ": none of the images could be placed");
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
