#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/scene/floor_plan_file.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Tenths of a millimetre are enough for a plan.
double rounded(double value) { return std::round(1e4 * value) / 1e4; }

ordered_json point_json(const Eigen::Vector2d& p) {
  return ordered_json::array({rounded(p[0]), rounded(p[1])});
}

ordered_json polygon_json(const std::vector<Eigen::Vector2d>& polygon) {
  ordered_json points = ordered_json::array();
  for (const Eigen::Vector2d& p : polygon) points.push_back(point_json(p));
  return points;
}

Eigen::Vector2d point_of(const json& value) {
  const Eigen::Vector2d p(value.at(0).get<double>(), value.at(1).get<double>());
  if (!p.allFinite()) throw ArgumentError("a point is not finite");
  return p;
}

std::vector<Eigen::Vector2d> polygon_of(const json& value) {
  std::vector<Eigen::Vector2d> points;
  for (const json& p : value) points.push_back(point_of(p));
  return points;
}

json read_document(const std::string& path) {
  require_input_file(path);
  std::ifstream file(path);
  if (!file) throw FileError(path, "cannot be read");
  try {
    return json::parse(file);
  } catch (const json::exception& error) {
    throw FileError(path, std::string("is not JSON: ") + error.what());
  }
}

/// The result of `read` for the document; its errors are rethrown with the file's path.
template <class Read>
auto read_as(const std::string& path, const char* form, Read read) {
  const json document = read_document(path);
  try {
    return read(document);
  } catch (const json::exception& error) {
    throw FileError(path, std::string("is not ") + form + ": " + error.what());
  } catch (const ArgumentError& error) {
    throw FileError(path, std::string("is not ") + form + ": " + error.what());
  }
}

}  // namespace

std::string to_json(const FloorPlan& plan) {
  ordered_json document;
  document["units"] = "m";
  document["frame"] =
      "x and z of the map, turned by R_plan_map so that y points straight down; floor at floor_y";
  const Eigen::Matrix3d R = plan.R_plan_map.matrix();
  document["R_plan_map"] = ordered_json::array();
  for (int i = 0; i < 3; ++i) document["R_plan_map"].push_back({R(i, 0), R(i, 1), R(i, 2)});
  document["floor_y"] = rounded(plan.floor_y);
  document["walls_yaw_rad"] = plan.yaw_rad;
  document["walls"] = ordered_json::array();
  for (const PlanWall& wall : plan.walls)
    document["walls"].push_back({{"a", point_json(wall.a)},
                                 {"b", point_json(wall.b)},
                                 {"normal", point_json(wall.normal)},
                                 {"sigma_m", rounded(wall.sigma_m)},
                                 {"low_m", rounded(wall.low_m)},
                                 {"high_m", rounded(wall.high_m)},
                                 {"points", wall.observations},
                                 {"place", wall.place ? wall.place->value() : -1}});
  document["doors"] = ordered_json::array();
  for (const PlanDoor& door : plan.doors)
    document["doors"].push_back(
        {{"a", point_json(door.a)},
         {"b", point_json(door.b)},
         {"height_m", rounded(door.height_m)},
         {"closed", door.closed},
         {"rooms", {door.rooms[0].value_or(-1), door.rooms[1].value_or(-1)}}});
  document["rooms"] = ordered_json::array();
  for (const PlanRoom& room : plan.rooms) {
    ordered_json holes = ordered_json::array();
    for (const auto& hole : room.holes) holes.push_back(polygon_json(hole));
    document["rooms"].push_back({{"label", room.label},
                                 {"area_m2", rounded(room.area_m2)},
                                 {"ceiling_m", rounded(room.ceiling_m)},
                                 {"entered", room.entered},
                                 {"places", room.places},
                                 {"outline", polygon_json(room.outline)},
                                 {"holes", holes}});
  }
  return document.dump(1) + "\n";
}

FloorPlan read_floor_plan(const std::string& path) {
  return read_as(path, "a floor plan of `placegraph run`", [](const json& document) {
    FloorPlan plan;
    Eigen::Matrix3d R;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) R(i, j) = document.at("R_plan_map").at(i).at(j).get<double>();
    plan.R_plan_map = SO3(Eigen::Quaterniond(R).normalized());
    plan.floor_y = document.at("floor_y").get<double>();
    plan.yaw_rad = document.at("walls_yaw_rad").get<double>();
    for (const json& entry : document.at("walls")) {
      PlanWall wall;
      wall.a = point_of(entry.at("a")), wall.b = point_of(entry.at("b"));
      wall.normal = point_of(entry.at("normal"));
      wall.sigma_m = entry.at("sigma_m").get<double>();
      wall.low_m = entry.at("low_m").get<double>(), wall.high_m = entry.at("high_m").get<double>();
      wall.observations = entry.at("points").get<int>();
      if (const auto place = entry.at("place").get<std::int64_t>(); place >= 0)
        wall.place = PlaceId(place);
      plan.walls.push_back(wall);
    }
    for (const json& entry : document.at("doors")) {
      PlanDoor door{point_of(entry.at("a")),
                    point_of(entry.at("b")),
                    entry.at("height_m").get<double>(),
                    entry.at("closed").get<bool>(),
                    {}};
      const auto rooms = entry.at("rooms").get<std::array<int, 2>>();
      for (std::size_t side = 0; side < 2; ++side)
        if (rooms[side] >= 0) door.rooms[side] = rooms[side];
      plan.doors.push_back(door);
    }
    for (const json& entry : document.at("rooms")) {
      PlanRoom room;
      room.label = entry.at("label").get<std::string>();
      room.area_m2 = entry.at("area_m2").get<double>();
      room.ceiling_m = entry.at("ceiling_m").get<double>();
      room.entered = entry.at("entered").get<bool>();
      room.places = entry.at("places").get<std::vector<PlaceId>>();
      room.outline = polygon_of(entry.at("outline"));
      for (const json& hole : entry.at("holes")) room.holes.push_back(polygon_of(hole));
      plan.rooms.push_back(std::move(room));
    }
    plan.outcome = Outcome::ok();
    return plan;
  });
}

TrueFloorPlan read_true_floor_plan(const std::string& path) {
  return read_as(path, "a true plan of `placegraph synth sequence`", [](const json& document) {
    TrueFloorPlan plan;
    for (const json& room : document.at("rooms"))
      plan.rooms.push_back({room.at("name").get<std::string>(), point_of(room.at("low")),
                            point_of(room.at("high")), room.at("ceiling_m").get<double>()});
    for (const json& wall : document.at("walls")) {
      for (const json& door : wall.at("doors"))
        plan.doors.push_back({point_of(door.at("a")), point_of(door.at("b")),
                              door.at("height_m").get<double>(), door.at("closed").get<bool>(),
                              static_cast<int>(plan.walls.size())});
      plan.walls.push_back({point_of(wall.at("a")), point_of(wall.at("b")),
                            wall.at("thickness_m").get<double>(),
                            wall.at("height_m").get<double>()});
    }
    return plan;
  });
}

}  // namespace placegraph
