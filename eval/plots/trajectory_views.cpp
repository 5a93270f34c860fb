#include <fmt/format.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/trajectory_views.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace placegraph {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastSide_px = 190;  ///< shortest side of a panel
constexpr double kMargin = 0.06;       ///< share of the data, on each side

/// The curve that determines the axes; nothing if there is none.
const PlotCurve* chooser_of(const Plot& plot) {
  const auto reference = std::ranges::find_if(plot.curves, &PlotCurve::reference);
  if (reference != plot.curves.end()) return &*reference;
  return plot.curves.empty() ? nullptr : &plot.curves.front();
}

/// Axes of the views: horizontal and vertical from above, and the third one.
std::array<int, 3> axes_of(const Plot& plot) {
  const PlotCurve* chooser = chooser_of(plot);
  const auto [horizontal, vertical] =
      chooser ? top_view_axes(chooser->positions_m) : std::pair(0, 1);
  return {horizontal, vertical, 3 - horizontal - vertical};
}

Interval extent_of(const Plot& plot, int axis) {
  Interval extent;
  for (const PlotCurve& curve : plot.curves)
    for (const auto& p : curve.positions_m)
      if (p) extent.add((*p)[axis]);
  return extent;
}

FigureAxis axis_of(const Plot& plot, int axis) {
  return {fmt::format("{} [{}]", "xyz"[axis], plot.unit),
          with_margin(extent_of(plot, axis), kMargin),
          false,
          {}};
}

FigureLine lines_of(const PlotLinks& links, const Stroke& stroke,
                    const std::function<Vector2d(const Vector3d&)>& seen) {
  FigureLine line{{}, stroke, {}};
  for (const auto& [a, b] : links) {
    line.points.emplace_back(seen(a));
    line.points.emplace_back(seen(b));
    line.points.emplace_back();
  }
  return line;
}

/// Thin and pale where there are many.
Stroke link_stroke(Colour colour, std::size_t count) {
  return {colour, count > 60 ? 0.8 : 1.4, count > 600 ? 0.3 : count > 60 ? 0.5 : 0.8, ""};
}

std::vector<FigureShape> shapes_of(const Plot& plot,
                                   const std::function<Vector2d(const Vector3d&)>& seen,
                                   double most_error_m) {
  std::vector<FigureShape> shapes;
  const std::vector<Stroke> strokes = curve_strokes(plot);
  const auto add_curves = [&](bool reference) {
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
      const PlotCurve& curve = plot.curves[i];
      if (curve.reference != reference) continue;
      FigureLine line{{}, strokes[i], {}, curve.series};
      for (const auto& p : curve.positions_m)
        line.points.push_back(p ? std::optional<Vector2d>(seen(*p)) : std::nullopt);
      for (const double error : curve.error_m) line.shares.push_back(error / most_error_m);
      shapes.emplace_back(std::move(line));
    }
  };
  add_curves(true);
  shapes.emplace_back(
      lines_of(plot.rejected_links_m, link_stroke(kRejected, plot.rejected_links_m.size()), seen));
  shapes.emplace_back(lines_of(plot.links_m, link_stroke(kLink, plot.links_m.size()), seen));
  add_curves(false);
  FigureDots places{{}, 2.5, kWhite, kInk}, start{{}, 5, kWhite, kInk};
  for (const Vector3d& place : plot.places_m) places.points.push_back(seen(place));
  if (const PlotCurve* chooser = chooser_of(plot))
    for (const auto& p : chooser->positions_m)
      if (p && start.points.empty()) start.points.push_back(seen(*p));
  shapes.emplace_back(std::move(places));
  shapes.emplace_back(std::move(start));
  return shapes;
}

FigurePanel panel_of(const Plot& plot, int horizontal, int vertical) {
  const auto seen = [=](const Vector3d& p) { return Vector2d(p[horizontal], p[vertical]); };
  Interval errors;
  errors.add(0);
  for (const PlotCurve& curve : plot.curves)
    for (const double error : curve.error_m) errors.add(error);
  errors.max = std::max(errors.max, kLeastError);
  FigurePanel panel;
  panel.x = axis_of(plot, horizontal);
  panel.y = axis_of(plot, vertical);
  panel.shapes = shapes_of(plot, seen, errors.max);
  for (std::size_t i = 0; i < plot.place_names.size(); ++i)
    panel.labels.push_back({seen(plot.places_m[i]), plot.place_names[i]});
  if (std::ranges::any_of(plot.curves, [](const PlotCurve& c) { return !c.error_m.empty(); }))
    panel.scale = {"position error [m]", errors};
  return panel;
}

/// Puts the picture of the ground below what the panel shows, whose ranges stay.
void add_ground(const Plot& plot, int horizontal, int vertical, FigurePanel& panel) {
  if (!plot.ground) return;
  const GroundPicture& ground = *plot.ground;
  require(horizontal == 0 && vertical == 1,
          fmt::format("{}: is a map of x and y, and the view from above shows {} and {}",
                      ground.name, "xyz"[horizontal], "xyz"[vertical]));
  Interval x, y;
  for (const int right : {0, ground.columns})
    for (const int down : {0, ground.rows}) {
      const Vector2d corner = ground.corner_m + right * ground.right_m + down * ground.down_m;
      x.add(corner[0]);
      y.add(corner[1]);
    }
  const bool meets = x.min < panel.x.range.max && x.max > panel.x.range.min &&
                     y.min < panel.y.range.max && y.max > panel.y.range.min;
  require(meets,
          fmt::format("{}: covers x {:.6g} to {:.6g} and y {:.6g} to {:.6g}, and the drive lies "
                      "elsewhere: is it in another frame?",
                      ground.name, x.min, x.max, y.min, y.max));
  constexpr double kOpacity = 0.6;  // chosen: curves stand out from it
  panel.shapes.insert(panel.shapes.begin(),
                      FigurePicture{ground.source, Vector2d(ground.columns, ground.rows),
                                    ground.corner_m, ground.right_m, ground.down_m, kOpacity});
}

/// The size of a panel of this content in equal scale: as large as allowed, no side too short.
Vector2d size_of(const FigurePanel& panel, const Vector2d& most_px) {
  const Vector2d content(panel.x.range.size(), panel.y.range.size());
  return (content * (most_px.array() / content.array()).minCoeff())
      .cwiseMax(kLeastSide_px)
      .cwiseMin(most_px);
}

/// How many pixels the third axis gets, and a remark if it is stretched for that.
std::pair<double, std::string> third_size(const FigureAxis& axis, double px_per_unit,
                                          double least_px) {
  constexpr double kMost_px = 640;
  const double equal_px = axis.range.size() * px_per_unit,
               size_px = std::clamp(equal_px, least_px, kMost_px), factor = size_px / equal_px;
  constexpr double kEqual = 0.05, kMost = 100;
  if (factor < 1 - kEqual || factor > kMost) return {size_px, "not to scale"};
  if (factor > 1 + kEqual) return {size_px, fmt::format("stretched {:.2g}x", factor)};
  return {size_px, ""};
}

}  // namespace

std::vector<Stroke> curve_strokes(const Plot& plot) {
  std::vector<Stroke> strokes;
  std::size_t estimate = 0;
  for (const PlotCurve& curve : plot.curves) {
    strokes.push_back(curve.reference ? Stroke{kReference, 4, 1, ""} : curve_stroke(estimate++));
    if (!curve.reference) strokes.back().width_px = curve.width_px;
  }
  return strokes;
}

FigurePanel view_from_above(const Plot& plot, const Vector2d& size_px) {
  const auto [horizontal, vertical, depth] = axes_of(plot);
  FigurePanel panel = panel_of(plot, horizontal, vertical);
  panel.size = size_px;
  make_equal(panel);
  add_ground(plot, horizontal, vertical, panel);
  return panel;
}

TrajectoryViews trajectory_views(const Plot& plot, const Vector2d& most_px) {
  const auto [horizontal, vertical, depth] = axes_of(plot);
  TrajectoryViews views;
  FigurePanel& above = views.above;
  above = panel_of(plot, horizontal, vertical);
  above.heading = horizontal == 0 ? "from above" : "view on the plane of largest extent";
  above.size = size_of(above, most_px);
  above.corner = {kLeftMargin, kTopMargin};
  make_equal(above);
  add_ground(plot, horizontal, vertical, above);
  const double right = above.scale ? kBarMargin : kRightMargin;
  views.width_px = kLeftMargin + above.size[0] + right;
  views.height_px = kTopMargin + above.size[1] + kBottomMargin;

  const double px_per_unit = above.size[0] / above.x.range.size();
  const double flat = 1e-6 * std::max(above.x.range.size(), above.y.range.size());
  if (!(extent_of(plot, depth).size() > flat)) return views;
  const bool below = above.size[0] >= above.size[1];
  FigurePanel side = below ? panel_of(plot, horizontal, depth) : panel_of(plot, depth, vertical);
  side.labels.clear();
  side.scale.reset();
  side.heading = "from the side";
  constexpr double kLeastLow_px = 110;
  const auto [third_px, remark] =
      third_size(below ? side.y : side.x, px_per_unit, below ? kLeastLow_px : kLeastSide_px);
  if (below) {
    if (!remark.empty()) side.heading += fmt::format(", {} {}", side.y.label.front(), remark);
    side.x.range = above.x.range;
    side.size = {above.size[0], third_px};
    side.corner = {kLeftMargin, views.height_px + kTopMargin};
    views.height_px += kTopMargin + third_px + kBottomMargin;
  } else {
    if (!remark.empty()) side.x.label += ", " + remark;
    side.y.range = above.y.range;
    side.size = {third_px, above.size[1]};
    side.corner = {views.width_px + kLeftMargin, kTopMargin};
    views.width_px += kLeftMargin + third_px + kRightMargin;
  }
  views.side = std::move(side);
  return views;
}

}  // namespace placegraph
