#include <fmt/format.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/eval/internal/plots/semantic_map_plot.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr double kStreetMargin_px = 30, kStreetTitle_px = 34, kLegend_px = 130;
constexpr Colour kStreetText{50, 50, 50}, kStreetPath{255, 230, 0}, kStreetWhite{255, 255, 255};

Colour colour_of(const SemanticMap& map, int label) {
  const auto rgb = class_colour(map.classes[static_cast<std::size_t>(label)], label);
  return {rgb[0], rgb[1], rgb[2]};
}

void draw_legend(PlotCanvas& canvas, const SemanticMap& map, const std::vector<bool>& shown,
                 double left) {
  double y = kStreetTitle_px + 14;
  for (std::size_t c = 0; c < map.classes.size(); ++c) {
    if (!shown[c]) continue;
    const Colour colour = colour_of(map, static_cast<int>(c));
    canvas.rectangle({left, y - 10}, {14, 12}, colour, colour);
    canvas.text({left + 20, y}, map.classes[c], 13, kStreetText, TextAnchor::kLeft);
    y += 20;
  }
}

}  // namespace

std::string semantic_map_png(const SemanticMap& map, const SemanticMapPicture& picture) {
  const TopView view = top_view(map);
  const double cell_px =
      std::clamp(std::floor(1400.0 / std::max({view.columns, view.rows, 1})), 1.0, 8.0);
  const double side_x = std::max(200.0, view.columns * cell_px),
               side_z = std::max(200.0, view.rows * cell_px);
  const int width = static_cast<int>(side_x + 2 * kStreetMargin_px + kLegend_px),
            height = static_cast<int>(side_z + 2 * kStreetMargin_px + kStreetTitle_px);
  const auto canvas = png_canvas(width, height);
  canvas->rectangle({0, 0}, {static_cast<double>(width), static_cast<double>(height)}, kStreetWhite,
                    kStreetWhite);
  const double bottom = height - kStreetMargin_px;
  std::vector<bool> shown(map.classes.size(), false);
  const auto label_at = [&](int column, int row) {
    const int cell = view.at(column, row);
    return cell < 0 ? -1 : *map.cells[static_cast<std::size_t>(cell)].label;
  };
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns;) {
      const int label = label_at(column, row), begin = column;
      while (column < view.columns && label_at(column, row) == label) ++column;
      if (label < 0) continue;
      shown[static_cast<std::size_t>(label)] = true;
      const Colour colour = colour_of(map, label);
      canvas->rectangle({kStreetMargin_px + begin * cell_px, bottom - (row + 1) * cell_px},
                        {(column - begin) * cell_px - 1, cell_px - 1}, colour, colour);
    }
  std::vector<Vector2d> line;
  const auto end_line = [&] {
    if (line.size() > 1) canvas->line(line, kStreetPath, 2);
    line.clear();
  };
  for (const std::optional<Vector2d>& p : picture.path) {
    if (!p) {
      end_line();
      continue;
    }
    const Vector2d at = *p / std::max(view.cell_m, 1e-6) - view.low.cast<double>();
    line.emplace_back(kStreetMargin_px + at[0] * cell_px, bottom - at[1] * cell_px);
  }
  end_line();
  draw_legend(*canvas, map, shown, kStreetMargin_px + side_x + 20);
  canvas->text({kStreetMargin_px, 22}, picture.title, 15, kStreetText, TextAnchor::kLeft);
  const double bar = 10 / std::max(view.cell_m, 1e-6) * cell_px, right = width - 20;
  if (bar < right - kStreetMargin_px) {
    canvas->line({{right - bar, height - 14.0}, {right, height - 14.0}}, kStreetText, 2);
    canvas->text({right, height - 20.0}, "10 m", 12, kStreetText, TextAnchor::kRight);
  }
  return canvas->encode();
}

}  // namespace placegraph
