#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/results/result_json.h>
#include <placegraph/pipeline/results/run_map.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using nlohmann::json;

Place place_of(const json& entry, RunMap& map) {
  Place place;
  place.id = entry.at("id").get<PlaceId>();
  place.anchor_keyframe = entry.at("anchor_keyframe").get<KeyframeId>();
  place.component = entry.at("component").get<int>();
  place.T_map_place = pose_of(entry.at("T_map_place"));
  place.scale = entry.at("scale").get<double>();
  place.labels = entry.at("labels").get<std::vector<std::string>>();
  for (const json& member : entry.at("members")) {
    place.members.push_back({member.at("keyframe").get<KeyframeId>(),
                             pose_of(member.at("T_place_keyframe")),
                             member.at("scale").get<double>()});
    if (member.contains("frame"))
      map.frame_of_keyframe[place.members.back().keyframe] = member.at("frame").get<FrameId>();
  }
  return place;
}

/// places.json lists the edges of graph.g2o in their order.
void take_edges(const json& edges, const PoseGraph& written, RunMap& map) {
  const char* mismatch = "its edges are not those of graph.g2o";
  require(edges.size() == written.constraints.size(), mismatch);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&written.constraints[i]);
    require(
        edge && edges[i].at("from") == edge->from.value() && edges[i].at("to") == edge->to.value(),
        mismatch);
    require(map.graph.find(place_of_node(edge->from)) && map.graph.find(place_of_node(edge->to)),
            mismatch);
    map.graph.constraints.push_back(*edge);
    const auto source = constraint_source(edges[i].at("source").get<std::string>());
    require(source.has_value(), "an edge's source is no source");
    map.graph.constraints.back().source = *source;
  }
}

/// Takes whether lengths are metres and the number of frames from result.json; a graph with scales
/// is not metric if the folder has none.
void take_result(const std::string& path, const PoseGraph& written, RunMap& map) {
  map.metric = written.kind() != PoseKind::kSim3;
  if (!std::filesystem::exists(path)) return;
  take_json(path, "run", [&](const json& result) {
    map.metric = metric_of(result);
    if (result.contains("frames")) map.frames = result.at("frames").get<std::size_t>();
  });
}

}  // namespace

const char* unit_of(bool metric) { return metric ? "m" : "units"; }

FrameId RunMap::anchor_frame(const Place& place) const {
  const auto frame = frame_of_keyframe.find(place.anchor_keyframe);
  if (frame == frame_of_keyframe.end())
    throw FileError(file, "place " + to_string(place.id) + " has no frame of its anchor");
  return frame->second;
}

namespace {

RunMap run_map_of(StoredMap stored, const std::string& path) {
  require(stored.origin.calibration.has_value(),
          path + ": is a map of images without a camera, in which nothing has a pose");
  RunMap map;
  map.file = path;
  map.metric = stored.map.metric;
  for (const Keyframe& keyframe : stored.map.keyframes)
    map.frame_of_keyframe[keyframe.id] = keyframe.frame;
  map.graph = std::move(stored.map.place_graph);
  return map;
}

}  // namespace

bool metric_of_run(const std::string& folder) {
  bool metric = true;
  take_json((std::filesystem::path(folder) / "result.json").string(), "run",
            [&](const json& result) { metric = metric_of(result); });
  return metric;
}

std::vector<std::pair<std::int64_t, PlaceId>> read_visits(const std::string& folder) {
  std::vector<std::pair<std::int64_t, PlaceId>> visits;
  take_json((std::filesystem::path(folder) / "places.json").string(), "run",
            [&](const json& document) {
              for (const json& place : document.at("places"))
                for (const json& member : place.at("members"))
                  visits.emplace_back(member.at("stamp_ns").get<std::int64_t>(),
                                      place.at("id").get<PlaceId>());
            });
  return visits;
}

RunMap read_run_map(const std::string& folder) {
  if (std::filesystem::is_regular_file(folder)) return run_map_of(read_map(folder), folder);
  const std::filesystem::path root(folder);
  const std::string path = (root / "places.json").string();
  const PoseGraph written = read_g2o((root / "graph.g2o").string());
  RunMap map;
  map.file = path;
  take_json(path, "run", [&](const json& document) {
    for (const json& entry : document.at("places"))
      map.graph.places.push_back(place_of(entry, map));
    take_edges(document.at("edges"), written, map);
  });
  take_result((root / "result.json").string(), written, map);
  return map;
}

}  // namespace placegraph
