#include <fmt/format.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/eval/plots/trajectory_views.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

std::vector<LegendEntry> legend_of(const Plot& plot) {
  std::vector<LegendEntry> legend;
  const std::vector<Stroke> strokes = curve_strokes(plot);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve& curve = plot.curves[i];
    LegendEntry entry{curve.name, strokes[i], LegendMark::kLine, curve.series};
    if (!curve.error_m.empty()) entry.mark = LegendMark::kScale;
    if (std::ranges::none_of(legend, [&](const auto& e) { return e.text == entry.text; }))
      legend.push_back(std::move(entry));
  }
  const auto count_of = [](std::size_t count, const char* one, const char* several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
  };
  if (!plot.curves.empty()) legend.push_back({"start", {kInk, 5}, LegendMark::kRing});
  if (!plot.places_m.empty())
    legend.push_back(
        {count_of(plot.places_m.size(), "place", "places"), {kInk, 2.5}, LegendMark::kRing});
  if (!plot.links_m.empty())
    legend.push_back(
        {count_of(plot.links_m.size(), "loop closure", "loop closures"), {kLink, 1.5}});
  if (!plot.rejected_links_m.empty())
    legend.push_back(
        {count_of(plot.rejected_links_m.size(), "rejected", "rejected"), {kRejected, 1.5}});
  return legend;
}

FigurePanel error_panel(const Plot& plot, bool over_time) {
  std::vector<Stroke> strokes;
  std::vector<std::string> series;
  for (std::size_t i = 0; i < plot.curves.size(); ++i)
    if (!plot.curves[i].reference) {
      strokes.push_back(curve_strokes(plot)[i]);
      series.push_back(plot.curves[i].series);
    }
  FigurePanel panel;
  Interval along, errors;
  along.add(0);
  for (const PlotError& error : plot.errors) {
    const std::vector<double>& at = over_time ? error.time_s : error.distance_m;
    const auto estimate = static_cast<std::size_t>(error.estimate);
    FigureLine line{{}, strokes.at(estimate), {}, series[estimate]};
    line.stroke.width_px = 1.6;
    for (std::size_t i = 0; i < at.size(); ++i) {
      along.add(at[i]);
      line.points.emplace_back();
      if (!error.error_m[i]) continue;
      line.points.back() = Vector2d(at[i], *error.error_m[i]);
      errors.add(*error.error_m[i]);
    }
    panel.shapes.emplace_back(std::move(line));
  }
  panel.heading = over_time ? "position error over time" : "position error over the distance";
  panel.x = {over_time ? "time [s]" : "distance travelled [m]", with_margin(along, 0), false, {}};
  panel.y = {"position error [m]", {0, std::max(1.06 * errors.max, kLeastError)}, false, {}};
  return panel;
}

void add_errors(const Plot& plot, const TrajectoryViews& views, Figure& figure) {
  constexpr double kWidth_px = 560, kLeastHeight_px = 210;
  const bool timed = std::ranges::any_of(plot.errors, [](const PlotError& error) {
    return error.time_s.size() > 1 && error.time_s.back() > 0;
  });
  const double count = timed ? 2 : 1, around = kTopMargin + kBottomMargin;
  const double height = std::max(views.height_px / count - around, kLeastHeight_px);
  for (int i = 0; i < (timed ? 2 : 1); ++i) {
    FigurePanel panel = error_panel(plot, i == 1);
    panel.corner = {views.width_px + kLeftMargin, kTopMargin + i * (height + around)};
    panel.size = {kWidth_px, height};
    figure.panels.push_back(std::move(panel));
  }
  figure.width_px = views.width_px + kLeftMargin + kWidth_px + kRightMargin;
  figure.height_px = std::max(figure.height_px, count * (height + around));
}

}  // namespace

std::pair<int, int> top_view_axes(const std::vector<std::optional<Eigen::Vector3d>>& positions_m) {
  Interval extent[3];
  for (const auto& p : positions_m)
    for (int axis = 0; p && axis < 3; ++axis) extent[axis].add((*p)[axis]);
  int least = 1;  // y, the height axis of a camera, if extents are equal
  for (const int axis : {0, 2})
    if (extent[axis].size() < extent[least].size()) least = axis;
  // A camera that drives straight ahead, even uphill: a top view does not include y.
  if (least == 0 && extent[1].size() < 0.5 * extent[2].size()) least = 1;
  return {least == 0 ? 1 : 0, least == 2 ? 1 : 2};
}

Figure figure_of(const Plot& plot) {
  Figure figure;
  figure.title = plot.title;
  figure.notes = plot.notes;
  if (plot.ground) figure.notes.push_back("map below: " + plot.ground->name);
  figure.legend = legend_of(plot);
  constexpr double kLeastWidth_px = 640;
  const Vector2d most_px = plot.errors.empty() ? Vector2d(900, 640) : Vector2d(760, 600);
  const TrajectoryViews views = trajectory_views(plot, most_px);
  figure.panels.push_back(views.above);
  if (views.side) figure.panels.push_back(*views.side);
  figure.width_px = std::max(views.width_px, kLeastWidth_px);
  figure.height_px = views.height_px;
  if (!plot.errors.empty()) add_errors(plot, views, figure);
  return figure;
}

std::string to_svg(const Plot& plot) { return to_svg(figure_of(plot)); }

Figure figure_of(const std::vector<Plot>& sequences, const std::string& title,
                 const std::vector<std::string>& notes) {
  const Vector2d size_px(330, 290),
      cell_px = size_px + Vector2d(kLeftMargin + kRightMargin, kTopMargin + kBottomMargin);
  const auto columns = static_cast<std::size_t>(
      std::clamp(std::ceil(std::sqrt(static_cast<double>(sequences.size()))), 1.0, 4.0));
  const std::size_t rows = (sequences.size() + columns - 1) / columns;
  Figure figure;
  figure.title = title;
  figure.notes = notes;
  figure.width_px = cell_px[0] * static_cast<double>(columns);
  figure.height_px = cell_px[1] * static_cast<double>(rows);
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    FigurePanel panel = view_from_above(sequences[i], size_px);
    panel.heading = sequences[i].title;
    panel.corner = {static_cast<double>(i % columns) * cell_px[0] + kLeftMargin,
                    static_cast<double>(i / columns) * cell_px[1] + kTopMargin};
    figure.panels.push_back(std::move(panel));
    for (LegendEntry& entry : legend_of(sequences[i]))
      if (std::ranges::none_of(figure.legend, [&](const auto& e) { return e.text == entry.text; }))
        figure.legend.push_back(std::move(entry));
  }
  return figure;
}

}  // namespace placegraph
