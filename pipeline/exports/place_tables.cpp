#include <fmt/format.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/pipeline/exports/place_tables.h>

#include <nlohmann/json.hpp>

namespace placegraph {

using nlohmann::json;

std::string places_json(const Map& map) {
  json places = json::array();
  for (const Place& place : map.place_graph.places) {
    json members = json::array();
    for (const PlaceMember& member : place.members) {
      const Keyframe* keyframe = map.find_keyframe(member.keyframe);
      json entry = {{"keyframe", member.keyframe},
                    {"T_place_keyframe", pose_json(member.T_place_keyframe)},
                    {"scale", member.scale}};
      if (keyframe) {
        entry["frame"] = keyframe->frame;
        entry["stamp_ns"] = keyframe->stamp_ns;
      }
      members.push_back(entry);
    }
    places.push_back({{"id", place.id},
                      {"anchor_keyframe", place.anchor_keyframe},
                      {"component", place.component},
                      {"T_map_place", pose_json(place.T_map_place)},
                      {"scale", place.scale},
                      {"members", members},
                      {"labels", place.labels},
                      {"visual_words", place.appearance.words.size()}});
  }
  json edges = json::array();
  for (const RelativePoseConstraint& c : map.place_graph.constraints)
    edges.push_back({{"from", c.from}, {"to", c.to}, {"source", to_string(c.source)}});
  json transitions = json::array();
  for (const PlaceTransition& t : place_transitions(map))
    transitions.push_back({{"from", t.from}, {"to", t.to}, {"count", t.count}});
  json loops = json::array();
  for (const LoopRecord& loop : map.loops)
    if (loop.accepted())
      loops.push_back({{"query_frame", loop.query_frame},
                       {"match_frame", loop.match_frame},
                       {"T_match_query", pose_json(loop.T_match_query)}});
  return json_text(
      json{{"places", places}, {"edges", edges}, {"transitions", transitions}, {"loops", loops}},
      1);
}

std::string loops_csv(const Map& map) {
  CsvText csv;
  csv.row("query", "match", "inliers", "accepted", "stage", "model", "lines", "likeness",
          "probability");
  for (const LoopRecord& loop : map.loops)
    csv.row(loop.query_frame, loop.match_frame, loop.inliers, loop.accepted() ? 1 : 0,
            to_string(loop.stage), to_string(loop.model), loop.lines,
            fmt::format("{:g}", loop.similarity), fmt::format("{:g}", loop.probability));
  return csv.text();
}

}  // namespace placegraph
