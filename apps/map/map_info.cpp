#include "apps/map/map_info.h"

#include <fmt/format.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/results/run_map.h>
#include <placegraph/pipeline/results/run_results.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <set>

#include "apps/results/result_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

json describe_map(const std::string& path, const StoredMap& stored) {
  const Map& map = stored.map;
  const MapSizes sizes = map_sizes(path);
  const Trajectory optimized = map.trajectory_optimized();
  std::set<int> components;
  for (const Place& place : map.place_graph.places) components.insert(place.component);
  std::int64_t features = 0, views = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    features += static_cast<std::int64_t>(keyframe.features.size());
    views += !keyframe.view.empty();
  }
  json info = {{"file", path},
               {"schema", sizes.schema},
               {"finished", stored.finished},
               {"verdict", stored.judgement ? json(to_string(stored.judgement->verdict)) : json()},
               {"sequence", stored.origin.sequence},
               {"sensor", stored.origin.calibration ? to_string(stored.origin.sensor) : "images"},
               {"places", map.place_graph.places.size()},
               {"components", components.size()},
               {"component_trajectories", json::parse(components_json(map))},
               {"keyframes", map.keyframes.size()},
               {"views", views},
               {"features", features},
               {"landmarks", map.landmarks.size()},
               {"constraints", map.place_graph.constraints.size()},
               {"loops_accepted", std::count_if(map.loops.begin(), map.loops.end(),
                                                [](const auto& loop) { return loop.accepted(); })},
               {"frames", map.frames.size()},
               {"posed", optimized.posed()},
               {"metric", map.metric},
               {"path_length", optimized.path_length()},
               {"file_bytes", sizes.file_bytes},
               {"features_bytes", sizes.features_bytes},
               {"views_bytes", sizes.views_bytes},
               {"landmarks_bytes", sizes.landmarks_bytes}};
  if (const auto& calibration = stored.origin.calibration) {
    info["image"] = {{"width", calibration->camera.width}, {"height", calibration->camera.height}};
    info["baseline_m"] = calibration->baseline_m;
  }
  return info;
}

std::string other_components(const json& components) {
  const std::string text = components_text(components);
  return text.empty() ? text : "           " + text + "\n";
}

json list_places(const StoredMap& stored) {
  json list = json::array();
  for (const Place& place : stored.map.place_graph.places) {
    const Keyframe* anchor = stored.map.find_keyframe(place.anchor_keyframe);
    const Eigen::Vector3d& t = place.T_map_place.translation();
    json position = nullptr;
    if (stored.origin.calibration) position = {t.x(), t.y(), t.z()};
    list.push_back({{"id", place.id},
                    {"component", place.component},
                    {"frame", anchor ? json(anchor->frame) : json(nullptr)},
                    {"keyframes", place.members.size()},
                    {"position", position},
                    {"labels", place.labels}});
  }
  return list;
}

std::string places_text(const json& list, const char* unit) {
  std::string text =
      fmt::format(" place  component  frame  keyframes  position x y z [{}]  labels\n", unit);
  for (const json& place : list) {
    std::string position = fmt::format("{:>9}", "-");
    if (const json& at = place["position"]; !at.is_null())
      position = fmt::format("{:>9.3f}{:>9.3f}{:>9.3f}", at[0].get<double>(), at[1].get<double>(),
                             at[2].get<double>());
    std::string labels;
    for (const json& label : place["labels"]) labels += "  " + label.get<std::string>();
    text += fmt::format("{:>6} {:>10} {:>6} {:>10}{}{}\n", place["id"].get<std::int64_t>(),
                        place["component"].get<int>(), place["frame"].dump(),
                        place["keyframes"].get<std::size_t>(), position, labels);
  }
  return text;
}

}  // namespace

MapInfoResult map_info(const MapInfoArguments& arguments) {
  const StoredMap stored = read_stored_map(arguments.map, messages());
  MapInfoResult result{describe_map(map_path_of(arguments.map), stored)};
  if (arguments.places) result.summary["place_list"] = list_places(stored);
  return result;
}

std::string to_text(const MapInfoResult& result) {
  const json& summary = result.summary;
  const auto count = [&](const char* key) { return summary[key].get<std::int64_t>(); };
  const auto megabytes = [&](const char* key) { return 1e-6 * summary[key].get<double>(); };
  const json& verdict = summary["verdict"];
  return fmt::format("{}: schema {}, {}, {}\n", summary["file"].get<std::string>(), count("schema"),
                     summary["finished"].get<bool>() ? "finished" : "broken off",
                     verdict.is_null() ? "not judged" : verdict.get<std::string>()) +
         fmt::format("  from     {} ({})\n", summary["sequence"].get<std::string>(),
                     summary["sensor"].get<std::string>()) +
         fmt::format("  places   {} in {} components, {} constraints, {} loops\n", count("places"),
                     count("components"), count("constraints"), count("loops_accepted")) +
         other_components(summary["component_trajectories"]) +
         fmt::format("  frames   {}, {} posed, {} keyframes, path {:.1f} {}\n", count("frames"),
                     count("posed"), count("keyframes"), summary["path_length"].get<double>(),
                     summary["metric"].get<bool>() ? "m" : "units (scale unknown)") +
         fmt::format("  content  {} features, {} views, {} landmarks\n", count("features"),
                     count("views"), count("landmarks")) +
         fmt::format("  size     {:.1f} MB: features {:.1f}, views {:.1f}, landmarks {:.1f}\n",
                     megabytes("file_bytes"), megabytes("features_bytes"), megabytes("views_bytes"),
                     megabytes("landmarks_bytes")) +
         (summary.contains("place_list")
              ? places_text(summary["place_list"], unit_of(summary["metric"].get<bool>()))
              : "");
}

std::string to_json(const MapInfoResult& result) { return json_text(result.summary, 1); }

}  // namespace placegraph::apps
