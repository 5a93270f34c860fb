#include "apps/map/queries/localize.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/run.h>

#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "apps/map/queries/query_images.h"
#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

LocalizerOptions options_of(const LocalizeArguments& arguments, const StoredMap& stored,
                            const std::string& path) {
  LocalizerOptions options = localizer_options_of(path, stored.origin);
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

/// The file name is a comment at the end, so that the numbers keep their columns.
std::string line_of(std::int64_t image, const std::string& name, const Localization& at) {
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
  return line + (name.empty() ? "\n" : "  # " + name + "\n");
}

json json_of(std::int64_t image, const std::string& name, const Localization& at) {
  json entry = {{"image", image},
                {"file", name},
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

LocalizeCounts count(const std::vector<Localization>& localizations) {
  LocalizeCounts counts;
  counts.images = localizations.size();
  for (const Localization& localization : localizations) {
    counts.placed += localization.placed;
    counts.posed += localization.T_map_cam.has_value();
    if (!localization.placed) ++counts.refused[localization.stage];
    if (!localization.without_pose.empty()) ++counts.without_pose[localization.without_pose];
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
std::string localizations_text(const LocalizeResult& result) {
  std::string text =
      "# image (number in natural order of the names, from 0), place and frame of the map (-1: "
      "none), probability, stage, pose T_map_cam: tx ty tz qx qy qz qw, # file name\n";
  for (std::size_t i = 0; i < result.localizations.size(); ++i)
    text += line_of(result.first + static_cast<std::int64_t>(i), result.names[i],
                    result.localizations[i]);
  return text;
}

std::string localizations_json(const LocalizeResult& result) {
  json list = json::array();
  for (std::size_t i = 0; i < result.localizations.size(); ++i)
    list.push_back(json_of(result.first + static_cast<std::int64_t>(i), result.names[i],
                           result.localizations[i]));
  return json_text(json{{"images", list}}, 1);
}

/// Reads the images and remembers the errors of those that cannot be read.
class QueryReader {
 public:
  explicit QueryReader(const QueryImages& images) : images_(images), errors_(images.count) {}

  /// An image; an empty frame if it cannot be read.
  Frame read(std::size_t i) {
    try {
      return images_.frame(i);
    } catch (const FileError& error) {
      errors_[i] = error.what();
      return {};
    }
  }
  /// Why an image was refused before the comparison, with its name; empty if it was compared.
  std::string refusal(std::size_t i, const Localization& at) const {
    if (at.stage == "unreadable") return errors_[i];
    if (at.stage != "grey") return "";
    const std::string name = images_.name(i);
    return (name.empty() ? fmt::format("image {}", images_.first + static_cast<std::int64_t>(i))
                         : name) +
           ": is grey, and the map's images have colour";
  }

 private:
  const QueryImages& images_;
  std::vector<std::string> errors_;
};

/// Warns of images that could not be compared, of the first ones by name.
void warn_of_refusals(const QueryReader& reader, const LocalizeResult& result) {
  constexpr std::size_t kNamed = 10;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < result.localizations.size(); ++i) {
    const std::string refusal = reader.refusal(i, result.localizations[i]);
    if (!refusal.empty() && ++refused <= kNamed) warn(refusal + "; the image is refused");
  }
  if (refused > kNamed)
    warn(fmt::format("{} more images are refused unread or as grey ones; {} names them",
                     refused - kNamed, result.out));
}

LocalizeResult localize_all(const LocalizeArguments& arguments, const MapLocalizer& localizer,
                            const QueryImages& images) {
  LocalizeResult result{arguments.out, images.first, {}, {}, {}, images.notes, 0, {}};
  for (std::size_t i = 0; i < images.count; ++i) result.names.push_back(images.name(i));
  QueryReader reader(images);
  {
    Progress progress("placing", static_cast<std::int64_t>(images.count), "images");
    result.localizations = localizer.localize(
        images.count,
        [&](std::size_t i) {
          progress.update(static_cast<std::int64_t>(i) + 1);
          return reader.read(i);
        },
        arguments.sequence);
  }
  warn_of_refusals(reader, result);
  result.counts = count(result.localizations);
  return result;
}

}  // namespace

LocalizeResult localize(const LocalizeArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const std::string path = map_path_of(arguments.map);
  StoredMap stored = read_stored_map(arguments.map, messages());
  const LocalizerOptions options = options_of(arguments, stored, path);
  const QueryImages images = query_images(arguments.images, arguments.range, stored.origin);
  for (const std::string& note : images.notes) warn(arguments.images + ": " + note);
  cv::setNumThreads(1);
  const MapLocalizer localizer(options, std::move(stored));
  const Stopwatch watch;
  LocalizeResult result = localize_all(arguments, localizer, images);
  write_file(arguments.out,
             arguments.as_json ? localizations_json(result) : localizations_text(result));
  result.cpu_ms_an_image = watch.cpu_ms() / static_cast<double>(result.localizations.size());
  if (result.counts.placed == 0)
    result.no_result = arguments.images + ": none of the images could be placed";
  return result;
}

std::string to_json(const LocalizeResult& result) {
  json summary = json_of(result.counts, result.notes);
  summary["cpu_ms_an_image"] = result.cpu_ms_an_image;
  return json_text(summary, 1);
}

std::string to_text(const LocalizeResult& result) {
  return fmt::format("{}, {:.1f} ms CPU an image, written to {}\n", text_of(result.counts),
                     result.cpu_ms_an_image, result.out);
}

}  // namespace placegraph::apps
