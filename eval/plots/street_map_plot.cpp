#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/street_map_plot.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr Colour kStreetPath{0, 0, 0};

Colour colour_of(const StreetMap& map, std::size_t label) {
  const auto rgb = class_colour(map.classes[label], static_cast<int>(label));
  return {rgb[0], rgb[1], rgb[2]};
}

/// The cells of every class as rings, rows of neighbours joined [m].
std::vector<FigureArea> areas_of(const StreetMap& map, const TopView& view, double cell_m) {
  std::vector<FigureArea> areas(map.classes.size());
  const auto label_at = [&](int column, int row) {
    const int cell = view.at(column, row);
    return cell < 0 ? -1 : *map.cells[static_cast<std::size_t>(cell)].label;
  };
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns;) {
      const int label = label_at(column, row), begin = column;
      while (column < view.columns && label_at(column, row) == label) ++column;
      if (label < 0) continue;
      const double left = cell_m * (view.low[0] + begin), right = cell_m * (view.low[0] + column),
                   low = cell_m * (view.low[1] + row), high = low + cell_m;
      areas[static_cast<std::size_t>(label)].rings.push_back(
          {{left, low}, {right, low}, {right, high}, {left, high}});
    }
  for (std::size_t c = 0; c < areas.size(); ++c) areas[c].fill = colour_of(map, c);
  return areas;
}

}  // namespace

std::string street_map_svg(const StreetMap& map, const StreetMapPicture& picture) {
  const TopView view = top_view(map);
  const double cell_m = std::max(view.cell_m, 1e-6);
  Figure figure;
  figure.title = picture.title;
  figure.notes = {"classes of the highest cells, from above"};
  FigurePanel panel;
  Interval x, z;
  if (view.columns > 0 && view.rows > 0) {
    x = {cell_m * view.low[0], cell_m * (view.low[0] + view.columns)};
    z = {cell_m * view.low[1], cell_m * (view.low[1] + view.rows)};
  }
  FigureLine path{picture.path, {kStreetPath, 2}, {}};
  for (const auto& p : picture.path)
    if (p) x.add((*p)[0]), z.add((*p)[1]);
  std::vector<FigureArea> areas = areas_of(map, view, cell_m);
  for (std::size_t c = 0; c < areas.size(); ++c) {
    if (areas[c].rings.empty()) continue;
    figure.legend.push_back({map.classes[c], {areas[c].fill}, LegendMark::kArea});
    panel.shapes.emplace_back(std::move(areas[c]));
  }
  if (!path.points.empty()) figure.legend.push_back({"path of the camera", path.stroke});
  panel.shapes.emplace_back(std::move(path));
  panel.x = {"x [m]", with_margin(x, 0.02, 1), false, {}};
  panel.y = {"z [m]", with_margin(z, 0.02, 1), false, {}};
  const Vector2d content(panel.x.range.size(), panel.y.range.size()), most(1300, 1000);
  panel.size = (content * (most.array() / content.array()).minCoeff()).cwiseMax(280);
  make_equal(panel);
  panel.corner = {kLeftMargin, 14};
  figure.width_px = std::max(560.0, kLeftMargin + panel.size[0] + kRightMargin);
  figure.height_px = 14 + panel.size[1] + kBottomMargin;
  figure.panels.push_back(std::move(panel));
  return to_svg(figure);
}

}  // namespace placegraph
