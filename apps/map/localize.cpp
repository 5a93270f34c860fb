#include "apps/map/localize.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/run.h>

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

/// Views are compared by the cues of their descriptions, features as in the run of the map.
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
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  options.check();
  return options;
}

/// Number of an id as in the files: -1 for none.
template <class Id>
std::int64_t number_of(const std::optional<Id>& id) {
  return id ? id->value() : -1;
}

std::string line_of(std::int64_t image, const Localization& at) {
  const std::int64_t place = at.placed ? number_of(at.place) : -1;
  const std::int64_t frame = at.placed ? number_of(at.frame) : -1;
  std::string line = fmt::format("{} {} {} {:.6f} {}", image, place, frame, at.probability,
                                 at.placed ? at.stage : "refused:" + at.stage);
  if (at.T_map_cam) {
    const auto& t = at.T_map_cam->translation();
    const auto& q = at.T_map_cam->rotation().quaternion();
    line += fmt::format(" {:.6f} {:.6f} {:.6f} {:.9f} {:.9f} {:.9f} {:.9f}", t.x(), t.y(), t.z(),
                        q.x(), q.y(), q.z(), q.w());
  }
  return line + "\n";
}

json json_of(std::int64_t image, const Localization& at) {
  json entry = {{"image", image},
                {"placed", at.placed},
                {"place", number_of(at.place)},
                {"view", number_of(at.frame)},
                {"keyframe", number_of(at.keyframe)},
                {"probability", at.probability},
                {"stage", at.stage}};
  if (at.T_map_cam) entry["T_map_cam"] = pose_json(*at.T_map_cam);
  if (!at.without_pose.empty()) entry["without_pose"] = at.without_pose;
  return entry;
}

LocalizeCounts count(const std::vector<Localization>& answers) {
  LocalizeCounts counts;
  counts.images = answers.size();
  for (const Localization& answer : answers) {
    counts.placed += answer.placed;
    counts.posed += answer.T_map_cam.has_value();
    if (!answer.placed) ++counts.refused[answer.stage];
    if (!answer.without_pose.empty()) ++counts.without_pose[answer.without_pose];
  }
  return counts;
}

std::string text_of(const LocalizeCounts& counts) {
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

json json_of(const LocalizeCounts& counts, const std::vector<std::string>& notes) {
  return {{"images", counts.images},
          {"placed", counts.placed},
          {"posed", counts.posed},
          {"without_pose", counts.without_pose},
          {"refused", counts.images - counts.placed},
          {"refused_by", counts.refused},
          {"notes", notes}};
}

/// The results as text, one line per image, or as JSON.
std::string answers_text(const LocalizeResult& result) {
  std::string text =
      "# image (number in natural order of the names, from 0), place and frame of the map (-1: "
      "none), probability, stage, pose T_map_cam: tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    text += line_of(result.first + static_cast<std::int64_t>(i), result.answers[i]);
  return text;
}

std::string answers_json(const LocalizeResult& result) {
  json list = json::array();
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    list.push_back(json_of(result.first + static_cast<std::int64_t>(i), result.answers[i]));
  return json{{"images", list}}.dump(1) + "\n";
}

}  // namespace

LocalizeResult localize(const LocalizeArguments& arguments) {
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
  LocalizeResult result{arguments.out, images.first, {}, {}, images.notes, 0, {}};
  result.answers = localizer.localize(
      images.count,
      [&](std::size_t i) {
        progress.update(static_cast<std::int64_t>(i) + 1);
        return images.frame(i);
      },
      arguments.sequence);
  result.counts = count(result.answers);
  write_file(arguments.out, arguments.as_json ? answers_json(result) : answers_text(result));
  result.cpu_ms_an_image = watch.cpu_ms() / static_cast<double>(result.answers.size());
  if (result.counts.placed == 0)
    result.no_answer = arguments.images + ": none of the images could be placed";
  return result;
}

std::string to_json(const LocalizeResult& result) {
  json summary = json_of(result.counts, result.notes);
  summary["cpu_ms_an_image"] = result.cpu_ms_an_image;
  return summary.dump(1) + "\n";
}

std::string to_text(const LocalizeResult& result) {
  return fmt::format("{}, {:.1f} ms CPU an image, written to {}\n", text_of(result.counts),
                     result.cpu_ms_an_image, result.out);
}

}  // namespace placegraph::apps
