#include <placegraph/pipeline/report/planes_part.h>

#include <placegraph/io/scene/floor_plan_file.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {
namespace {

using nlohmann::json;
using Polygon = std::vector<Eigen::Vector2d>;
using Rgb = std::array<int, 3>;

constexpr Rgb kWall = {140, 170, 205}, kDoor = {230, 159, 0}, kFloor = {120, 150, 110};

json polyline(const std::string& label, bool closed, const Polygon& points) {
  std::vector<float> coordinates;
  for (const Eigen::Vector2d& point : points)
    for (int i = 0; i < 2; ++i) coordinates.push_back(static_cast<float>(point[i]));
  return {{"label", label}, {"closed", closed}, {"points", column(coordinates, 2)}};
}

std::string name_of(const PlanRoom& room) { return room.label.empty() ? "room" : room.label; }

/// A column of points of the plan at heights above its floor, in the map.
class InMap {
 public:
  explicit InMap(const FloorPlan& plan) : plan_(plan) {}
  void put(const Eigen::Vector2d& at, double height_m) {
    const Eigen::Vector3d p = plan_.R_plan_map.inverse().matrix() *
                              Eigen::Vector3d(at.x(), plan_.floor_y - height_m, at.y());
    for (int i = 0; i < 3; ++i) values_.push_back(static_cast<float>(p[i]));
  }
  json take() { return column(std::exchange(values_, {}), 3); }

 private:
  const FloorPlan& plan_;
  std::vector<float> values_;
};

json plane(const std::string& name, const Rgb& rgb, json outline, json holes = json::array()) {
  return {
      {"name", name}, {"rgb", rgb}, {"outline", std::move(outline)}, {"holes", std::move(holes)}};
}

json upright(const FloorPlan& plan, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
             double low_m, double high_m) {
  InMap points(plan);
  points.put(a, low_m);
  points.put(b, low_m);
  points.put(b, high_m);
  points.put(a, high_m);
  return points.take();
}

json on_floor(const FloorPlan& plan, const Polygon& polygon) {
  InMap points(plan);
  for (const Eigen::Vector2d& point : polygon) points.put(point, 0);
  return points.take();
}

}  // namespace

std::optional<FloorPlan> floor_plan_in(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder) / "floor_plan.json";
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  return read_floor_plan(path.string());
}

json up_of_plan(const SO3& R_plan_map) {
  const Eigen::Vector3d up = R_plan_map.inverse().matrix() * Eigen::Vector3d(0, -1, 0);
  return {up.x(), up.y(), up.z()};
}

json describe_floor_plan(const FloorPlan& plan) {
  json lines = json::array();
  for (const PlanRoom& room : plan.rooms) {
    lines.push_back(polyline(name_of(room), true, room.outline));
    for (const Polygon& hole : room.holes) lines.push_back(polyline("hole", true, hole));
  }
  for (const PlanWall& wall : plan.walls)
    lines.push_back(polyline("wall", false, {wall.a, wall.b}));
  for (const PlanDoor& door : plan.doors)
    lines.push_back(polyline("door", false, {door.a, door.b}));
  return lines;
}

json describe_planes(const FloorPlan& plan) {
  json planes = json::array();
  for (const PlanRoom& room : plan.rooms) {
    json holes = json::array();
    for (const Polygon& hole : room.holes) holes.push_back(on_floor(plan, hole));
    planes.push_back(
        plane("floor of " + name_of(room), kFloor, on_floor(plan, room.outline), holes));
  }
  for (const PlanWall& wall : plan.walls)
    planes.push_back(plane("wall" + (wall.place ? " of place " + to_string(*wall.place) : ""),
                           kWall, upright(plan, wall.a, wall.b, wall.low_m, wall.high_m)));
  for (const PlanDoor& door : plan.doors)
    if (door.height_m > 0)
      planes.push_back(plane(door.closed ? "closed door" : "open door", kDoor,
                             upright(plan, door.a, door.b, 0, door.height_m)));
  return planes;
}

}  // namespace placegraph::report
