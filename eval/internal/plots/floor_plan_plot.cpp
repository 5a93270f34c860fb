#include <fmt/format.h>
#include <placegraph/eval/internal/plots/floor_plan_plot.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr double kPlanMargin_px = 40, kPlanTitle_px = 40;
constexpr Colour kWall{30, 30, 30}, kOpen{40, 150, 60}, kClosed{200, 110, 20},
    kPlanPath{90, 130, 220}, kTruth{235, 150, 150}, kPlanText{60, 60, 60};
constexpr Colour kRooms[] = {{120, 160, 200}, {190, 150, 90},  {120, 180, 130},
                             {180, 120, 170}, {150, 150, 150}, {200, 120, 110}};

/// From the plan to the picture.
struct PlanScale {
  Vector2d low = Vector2d::Constant(1e9), high = Vector2d::Constant(-1e9);
  double px_per_m = 1;
  int width = 0, height = 0;

  void take(const Vector2d& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  void settle() {
    if (low[0] > high[0]) low = Vector2d::Zero(), high = Vector2d::Ones();
    const Vector2d extent = (high - low).cwiseMax(Vector2d::Constant(1));
    px_per_m = std::min(1100 / extent[0], 900 / extent[1]);
    width = static_cast<int>(extent[0] * px_per_m + 2 * kPlanMargin_px);
    height = static_cast<int>(extent[1] * px_per_m + 2 * kPlanMargin_px + kPlanTitle_px);
  }
  Vector2d operator()(const Vector2d& p) const {
    return {kPlanMargin_px + (p[0] - low[0]) * px_per_m,
            height - kPlanMargin_px - (p[1] - low[1]) * px_per_m};
  }
};

PlanScale scale_of(const IndoorMap& plan, const FloorPlanPicture& picture) {
  PlanScale scale;
  for (const IndoorWall& wall : plan.walls) scale.take(wall.a), scale.take(wall.b);
  for (const IndoorRoom& room : plan.rooms)
    for (const Vector2d& p : room.outline) scale.take(p);
  for (const Vector2d& p : picture.path) scale.take(p);
  if (picture.truth)
    for (const BuildingPlan::Wall& wall : picture.truth->walls)
      scale.take(wall.a), scale.take(wall.b);
  scale.settle();
  return scale;
}

void draw_ring(PlotCanvas& canvas, const PlanScale& scale, const std::vector<Vector2d>& ring,
               Colour colour) {
  if (ring.empty()) return;
  std::vector<Vector2d> points;
  for (const Vector2d& p : ring) points.push_back(scale(p));
  points.push_back(points.front());
  canvas.line(points, colour, 2.5);
}

void draw_truth(PlotCanvas& canvas, const PlanScale& scale, const BuildingPlan& truth) {
  for (const BuildingPlan::Wall& wall : truth.walls) {
    const Vector2d axis = (wall.b - wall.a).normalized(),
                   off = 0.5 * wall.thickness_m * Vector2d(-axis[1], axis[0]);
    for (const double side : {-1.0, 1.0})
      canvas.line({scale(wall.a + side * off), scale(wall.b + side * off)}, kTruth, 1);
  }
  for (const BuildingPlan::Door& door : truth.doors)
    canvas.line({scale(door.a), scale(door.b)}, kTruth, 5);
}

/// A point of the room for its name: the middle of its outline, or of its longest edge moved inside
/// where there is a hole.
Vector2d name_at(const IndoorRoom& room) {
  Vector2d low = room.outline.front(), high = low;
  for (const Vector2d& p : room.outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (room.holes.empty()) return 0.5 * (low + high);
  return {0.5 * (low[0] + high[0]), low[1] + 0.5};
}

std::string draw(const IndoorMap& plan, const FloorPlanPicture& picture, bool svg) {
  const PlanScale scale = scale_of(plan, picture);
  const auto canvas =
      svg ? svg_canvas(scale.width, scale.height) : png_canvas(scale.width, scale.height);
  canvas->rectangle({0, 0}, {static_cast<double>(scale.width), static_cast<double>(scale.height)},
                    {255, 255, 255}, {255, 255, 255});
  if (picture.truth) draw_truth(*canvas, scale, *picture.truth);
  for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
    const Colour colour = kRooms[i % std::size(kRooms)];
    draw_ring(*canvas, scale, plan.rooms[i].outline, colour);
    for (const auto& hole : plan.rooms[i].holes) draw_ring(*canvas, scale, hole, colour);
  }
  std::vector<Vector2d> path;
  for (const Vector2d& p : picture.path) path.push_back(scale(p));
  if (path.size() > 1) canvas->line(path, kPlanPath, 1);
  for (const IndoorWall& wall : plan.walls) canvas->line({scale(wall.a), scale(wall.b)}, kWall, 3);
  for (const IndoorDoor& door : plan.doors)
    canvas->line({scale(door.a), scale(door.b)}, door.closed ? kClosed : kOpen, 5);
  for (const IndoorRoom& room : plan.rooms)
    if (!room.outline.empty())
      canvas->text(scale(name_at(room)), fmt::format("{}, {:.1f} m2", room.label, room.area_m2), 13,
                   kPlanText, TextAnchor::kMiddle);
  canvas->text({kPlanMargin_px, 24}, picture.title, 16, kPlanText, TextAnchor::kLeft);
  // One metre, or five.
  const double metres = (scale.high - scale.low).maxCoeff() > 15 ? 5 : 1;
  const double right = scale.width - kPlanMargin_px;
  canvas->line({{right - metres * scale.px_per_m, 20}, {right, 20}}, kPlanText, 2);
  canvas->text({right, 36}, fmt::format("{:.0f} m", metres), 12, kPlanText, TextAnchor::kRight);
  return canvas->encode();
}

}  // namespace

std::string floor_plan_svg(const IndoorMap& plan, const FloorPlanPicture& picture) {
  return draw(plan, picture, true);
}
std::string floor_plan_png(const IndoorMap& plan, const FloorPlanPicture& picture) {
  return draw(plan, picture, false);
}

}  // namespace placegraph
