#include <fmt/format.h>
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/floor_plan_plot.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr Colour kWall{30, 30, 30}, kDoor{213, 94, 0}, kPlanPath{0, 114, 178},
    kTruth{204, 121, 167};
constexpr Colour kRooms[] = {{214, 226, 240}, {240, 228, 204}, {216, 236, 218},
                             {234, 218, 234}, {228, 228, 228}, {244, 220, 214}};

FigureLine line_through(const std::vector<Vector2d>& points, const Stroke& stroke) {
  return {{points.begin(), points.end()}, stroke, {}};
}

void add_truth(const TrueFloorPlan& truth, std::vector<FigureShape>& shapes) {
  for (const TrueFloorPlan::Wall& wall : truth.walls) {
    const Vector2d axis = (wall.b - wall.a).normalized(),
                   off = 0.5 * wall.thickness_m * Vector2d(-axis[1], axis[0]);
    for (const double side : {-1.0, 1.0})
      shapes.emplace_back(line_through({wall.a + side * off, wall.b + side * off}, {kTruth}));
  }
  for (const TrueFloorPlan::Door& door : truth.doors)
    shapes.emplace_back(line_through({door.a, door.b}, {kTruth, 5}));
}

/// The fill of a room, widened by a stroke to the walls that bound it.
void add_room(const PlanRoom& room, Colour colour, std::vector<FigureShape>& shapes) {
  if (room.outline.empty()) return;
  FigureArea area{{room.outline}, colour, 1};
  area.rings.insert(area.rings.end(), room.holes.begin(), room.holes.end());
  for (std::vector<Vector2d> ring : area.rings) {
    ring.push_back(ring.front());
    shapes.emplace_back(line_through(ring, {kFrame, 1, 0.55}));
  }
  shapes.emplace_back(std::move(area));
}

/// Whether a line from the point upwards crosses the ring an odd number of times.
bool is_within(const std::vector<Vector2d>& ring, const Vector2d& p) {
  bool within = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a[0] > p[0]) == (b[0] > p[0])) continue;
    within ^= p[1] < a[1] + (p[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
  return within;
}

/// Area of the room at a point; 0 if there is none.
double area_at(const FloorPlan& plan, const Vector2d& p) {
  for (const PlanRoom& room : plan.rooms)
    if (is_within(room.outline, p) &&
        std::ranges::none_of(room.holes, [&](const auto& hole) { return is_within(hole, p); }))
      return room.area_m2;
  return 0;
}

/// The unit normal of a door towards the larger of its rooms, where a leaf has room.
Vector2d swing_side(const FloorPlan& plan, const PlanDoor& door) {
  const Vector2d axis = (door.b - door.a).normalized(), normal(-axis[1], axis[0]),
                 middle = 0.5 * (door.a + door.b);
  constexpr double kBeside_m = 0.4;
  return area_at(plan, middle + kBeside_m * normal) >= area_at(plan, middle - kBeside_m * normal)
             ? normal
             : Vector2d(-normal);
}

void add_door(const FloorPlan& plan, const PlanDoor& door, std::vector<FigureShape>& shapes) {
  const Vector2d across = door.b - door.a;
  if (!(across.norm() > 0)) return;
  const Vector2d leaf = across.norm() * swing_side(plan, door);
  constexpr int kParts = 16;
  std::vector<Vector2d> arc = {door.a};
  for (int i = 0; i <= kParts; ++i) {
    const double angle = std::numbers::pi / 2 * i / kParts;
    arc.emplace_back(door.a + std::sin(angle) * across + std::cos(angle) * leaf);
  }
  shapes.emplace_back(line_through({door.a, door.b}, {kWhite, 5}));
  shapes.emplace_back(line_through(arc, {kDoor, 1.3}));
  if (door.closed) shapes.emplace_back(line_through({door.a, door.b}, {kDoor, 4}));
}

double distance_to(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length2 = along.squaredNorm(),
               share = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (p - a - share * along).norm();
}

/// Distance from a point of a room to its outline, its holes and the doors, with their leaves.
double room_around(const FloorPlan& plan, const PlanRoom& room, const Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  const auto keep_off = [&](const std::vector<Vector2d>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      distance = std::min(distance, distance_to(p, ring[i], ring[(i + 1) % ring.size()]));
  };
  keep_off(room.outline);
  std::ranges::for_each(room.holes, keep_off);
  for (const PlanDoor& door : plan.doors)
    distance = std::min(distance, distance_to(p, door.a, door.b) - 0.5 * (door.b - door.a).norm());
  return distance;
}

/// The point of a room with the most room around it, for its name.
Vector2d name_at(const FloorPlan& plan, const PlanRoom& room) {
  Vector2d low = room.outline.front(), high = low;
  for (const Vector2d& p : room.outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  constexpr int kSteps = 41;
  Vector2d best = 0.5 * (low + high);
  double most = 0;
  for (int i = 1; i < kSteps; ++i)
    for (int k = 1; k < kSteps; ++k) {
      const Vector2d p(low[0] + (high[0] - low[0]) * i / kSteps,
                       low[1] + (high[1] - low[1]) * k / kSteps);
      const double around = is_within(room.outline, p) ? room_around(plan, room, p) : 0;
      const bool in_hole =
          std::ranges::any_of(room.holes, [&](const auto& hole) { return is_within(hole, p); });
      if (!in_hole && around > most) most = around, best = p;
    }
  return best;
}

void set_ranges(const FloorPlan& plan, const FloorPlanPicture& picture, FigurePanel& panel) {
  Interval x, z;
  const auto take = [&](const Vector2d& p) { x.add(p[0]), z.add(p[1]); };
  for (const PlanWall& wall : plan.walls) take(wall.a), take(wall.b);
  for (const PlanRoom& room : plan.rooms) std::ranges::for_each(room.outline, take);
  std::ranges::for_each(picture.path, take);
  if (picture.truth)
    for (const TrueFloorPlan::Wall& wall : picture.truth->walls) take(wall.a), take(wall.b);
  panel.x = {"x [m]", with_margin(x, 0.03, 1), false, {}};
  panel.y = {"z [m]", with_margin(z, 0.03, 1), false, {}};
  const Vector2d content(panel.x.range.size(), panel.y.range.size()), most(1000, 800);
  panel.size = (content * (most.array() / content.array()).minCoeff()).cwiseMax(280);
  make_equal(panel);
}

std::vector<LegendEntry> legend_of(const FloorPlan& plan, const FloorPlanPicture& picture) {
  std::vector<LegendEntry> legend = {{"wall", {kWall, 4}}};
  if (!plan.rooms.empty()) legend.push_back({"room", {kRooms[0]}, LegendMark::kArea});
  const auto closed = [](const PlanDoor& door) { return door.closed; };
  if (!std::ranges::all_of(plan.doors, closed))
    legend.push_back({"doorway (its hinges are not observed)", {kDoor, 1.3}});
  if (std::ranges::any_of(plan.doors, closed)) legend.push_back({"closed door", {kDoor, 4}});
  if (picture.path.size() > 1) legend.push_back({"path of the camera", {kPlanPath, 1.3}});
  if (picture.truth) legend.push_back({"ground truth", {kTruth, 1.5}});
  return legend;
}

}  // namespace

std::string floor_plan_svg(const FloorPlan& plan, const FloorPlanPicture& picture) {
  FigurePanel panel;
  set_ranges(plan, picture, panel);
  panel.corner = {kLeftMargin, 14};
  std::vector<FigureShape>& shapes = panel.shapes;
  double area_m2 = 0;
  for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
    add_room(plan.rooms[i], kRooms[i % std::size(kRooms)], shapes);
    area_m2 += plan.rooms[i].area_m2;
  }
  if (picture.truth) add_truth(*picture.truth, shapes);
  for (const PlanWall& wall : plan.walls)
    shapes.emplace_back(line_through({wall.a, wall.b}, {kWall, 4}));
  if (picture.path.size() > 1)
    shapes.emplace_back(line_through(picture.path, {kPlanPath, 1.3, 0.8}));
  for (const PlanRoom& room : plan.rooms)
    if (!room.outline.empty())
      shapes.emplace_back(
          FigureText{name_at(plan, room), fmt::format("{}\n{:.1f} m²", room.label, room.area_m2)});
  for (const PlanDoor& door : plan.doors) add_door(plan, door, shapes);
  Figure figure;
  figure.title = picture.title;
  figure.notes = {fmt::format("floor plan: {} room{}, {:.1f} m²", plan.rooms.size(),
                              plan.rooms.size() == 1 ? "" : "s", area_m2)};
  figure.legend = legend_of(plan, picture);
  figure.width_px = kLeftMargin + panel.size[0] + kRightMargin;
  figure.height_px = 14 + panel.size[1] + kBottomMargin;
  figure.panels.push_back(std::move(panel));
  return to_svg(figure);
}

}  // namespace placegraph
