#include "tests/bench/rate_plot.h"

#include <fmt/format.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <fstream>

namespace placegraph::bench {
namespace {

using Eigen::Vector2d;

constexpr Colour kInk{40, 40, 40}, kGrid{228, 228, 228}, kWhite{255, 255, 255};
constexpr Colour kPalette[] = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                               {204, 121, 167}, {230, 159, 0}, {90, 90, 90}};
constexpr double kWidth = 520, kHeight = 400, kText = 15;

struct Area {
  Vector2d corner, size;
  double most;
  Vector2d px(double at, double rate) const {
    return {corner[0] + size[0] * at / most, corner[1] + size[1] * (1 - rate)};
  }
};

void draw_panel(PlotCanvas& canvas, const Area& area, const RatePanel& panel,
                const std::string& label, double tick) {
  const double bottom = area.corner[1] + area.size[1];
  canvas.text({area.corner[0], area.corner[1] - 12}, panel.heading, kText + 1, kInk,
              TextAnchor::kLeft);
  for (int percent = 0; percent <= 100; percent += 20) {
    const Vector2d left = area.px(0, percent / 100.0);
    canvas.line({left, area.px(area.most, percent / 100.0)}, kGrid, 1);
    canvas.text({left[0] - 8, left[1] + 5}, fmt::format("{} %", percent), kText - 1, kInk,
                TextAnchor::kRight);
  }
  for (double at = 0; at <= area.most + 1e-9; at += tick) {
    canvas.line({area.px(at, 0), area.px(at, 1)}, kGrid, 1);
    canvas.text({area.px(at, 0)[0], bottom + 20}, fmt::format("{:g}", at), kText - 1, kInk,
                TextAnchor::kMiddle);
  }
  canvas.text({area.corner[0] + area.size[0] / 2, bottom + 42}, label, kText, kInk,
              TextAnchor::kMiddle);
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const RateCurve& curve = panel.curves[i];
    const Colour colour = kPalette[i % std::size(kPalette)];
    std::vector<Vector2d> points;
    for (std::size_t k = 0; k < curve.at.size(); ++k)
      points.push_back(area.px(curve.at[k], curve.rate[k]));
    if (points.size() > 1) canvas.line(points, colour, 2.5);
    for (const Vector2d& point : points) canvas.disc(point, 3.5, kWhite, colour);
    const Vector2d at(area.corner[0] + 12,
                      bottom - 14 - 20.0 * static_cast<double>(panel.curves.size() - 1 - i));
    canvas.line({at - Vector2d(0, 5), at + Vector2d(26, -5)}, colour, 2.5);
    canvas.text(at + Vector2d(34, 0), curve.name, kText - 1, kInk, TextAnchor::kLeft);
  }
}

}  // namespace

void write_rate_plot(const std::string& path, const std::string& title, const std::string& label,
                     const std::vector<RatePanel>& panels, int columns) {
  require(!panels.empty() && columns > 0, "rate plot: no panels");
  double most = 0;
  for (const RatePanel& panel : panels)
    for (const RateCurve& curve : panel.curves)
      for (const double at : curve.at) most = std::max(most, at);
  require(most > 0, "rate plot: nothing to show");
  const double tick = most > 40 ? 10 : most > 16 ? 4 : 2;
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int width = static_cast<int>(kWidth) * columns;
  const int height = 60 + static_cast<int>(kHeight) * rows;
  const bool svg = path.ends_with(".svg");
  const auto canvas = svg ? svg_canvas(width, height) : png_canvas(width, height);
  canvas->rectangle({0, 0}, {static_cast<double>(width), static_cast<double>(height)}, kWhite,
                    kWhite);
  canvas->text({width / 2.0, 36}, title, kText + 6, kInk, TextAnchor::kMiddle);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Vector2d corner(
        kWidth * static_cast<double>(i % static_cast<std::size_t>(columns)) + 66,
        kHeight * static_cast<double>(i / static_cast<std::size_t>(columns)) + 96);
    draw_panel(*canvas, {corner, {kWidth - 92, kHeight - 106}, most}, panels[i], label, tick);
  }
  std::ofstream file(path, std::ios::binary);
  file << canvas->encode();
  require(file.good(), path + ": cannot be written");
}

}  // namespace placegraph::bench
