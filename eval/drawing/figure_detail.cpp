#include <placegraph/eval/drawing/figure_detail.h>
#include <placegraph/eval/drawing/line_thinning.h>
#include <placegraph/eval/drawing/svg_canvas.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr int kLevels = 24;  ///< of the colours of a line

/// Bytes of all lines and of all dots of a picture that grow with the number of points, and of what
/// they are made of (svg_canvas.cpp).
constexpr std::size_t kMostLineBytes = 170'000, kMostDotBytes = 60'000;
constexpr std::size_t kPointBytes = 13, kLeastPointBytes = 4, kStrokeBytes = 140, kDotBytes = 105,
                      kThinnedDotBytes = 42;

/// Tolerances [px]: the first one is not seen, the last one spans a picture.
constexpr double kFirst_px = 0.5;
constexpr int kSteps = 24;
double tolerance(int step) { return kFirst_px * std::pow(std::numbers::sqrt2, step); }

int level_at(const FigureLine& line, std::size_t i) {
  return static_cast<int>(std::lround(std::clamp(line.shares[i], 0.0, 1.0) * kLevels));
}

Stroke stroke_of(const FigureLine& line, int level) {
  Stroke stroke = line.stroke;
  if (!line.shares.empty()) stroke.colour = scale_colour(static_cast<double>(level) / kLevels);
  return stroke;
}

/// The whole line; points that follow another one closely are dropped.
std::vector<DrawnLine> whole_lines(const FigureLine& line, const PanelView& view) {
  constexpr double kNear_px = 0.3;
  std::vector<DrawnLine> drawn;
  std::vector<Vector2d> stretch;
  int level = 0;
  const auto end = [&] {
    if (stretch.size() == 1) stretch.push_back(stretch.front() + Vector2d(0.5, 0));
    if (!stretch.empty()) drawn.push_back({stroke_of(line, level), {stretch}});
    stretch.clear();
  };
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (!line.points[i] || !line.points[i]->allFinite()) {
      end();
      continue;
    }
    const Vector2d px = view(*line.points[i]);
    const int own = line.shares.empty() ? 0 : level_at(line, i);
    if (!stretch.empty() && own != level) {
      stretch.push_back(px);
      end();
    }
    const bool last = i + 1 == line.points.size() || !line.points[i + 1];
    if (stretch.empty()) level = own;
    if (stretch.empty() || last || (stretch.back() - px).norm() > kNear_px) stretch.push_back(px);
  }
  end();
  return drawn;
}

/// The panel and as much around it as a stroke may be wide.
PixelArea seen_area(const PanelView& view) {
  const Vector2d around_px(16, 16);
  return {view.corner - around_px, view.size + 2 * around_px};
}

/// Bytes of a shape; nothing if they are more than allowed.
using ShapeBytes = std::function<std::optional<std::size_t>(double tolerance_px, std::size_t most)>;

/// A shape of which the bytes are limited.
struct Limited {
  double* tolerance_px;
  ShapeBytes bytes_of;
  std::size_t bytes = 0;  ///< with its tolerance

  /// Sets the smallest tolerance of the series that fits, or the last one.
  /// Halves the series, as small tolerances take longest where they do not fit.
  void fit(std::size_t most) {
    int low = 0, high = kSteps;
    while (low < high) {
      const int middle = (low + high) / 2;
      if (bytes_of(tolerance(middle), most))
        high = middle;
      else
        low = middle + 1;
    }
    *tolerance_px = tolerance(high);
    bytes = bytes_of(*tolerance_px, most).value_or(most);
  }
  bool thinned_visibly() const { return *tolerance_px > kFirst_px; }
};

ShapeBytes bytes_of(const FigureLine& line, const PanelView& view) {
  return [&line, view](double tolerance_px, std::size_t most) -> std::optional<std::size_t> {
    const auto drawn = drawn_lines(line, view, tolerance_px, most / kLeastPointBytes);
    if (!drawn) return std::nullopt;
    std::size_t bytes = 0;
    for (const DrawnLine& each : *drawn) {
      if (tolerance_px > 0)
        bytes += path_in_tenths(each.stretches).size();
      else
        bytes += kStrokeBytes + kPointBytes * each.stretches.front().size();
      if (bytes > most) return std::nullopt;
    }
    return bytes;
  };
}

ShapeBytes bytes_of(const FigureDots& dots, const PanelView& view) {
  return [&dots, view](double tolerance_px, std::size_t most) -> std::optional<std::size_t> {
    const std::size_t bytes = (tolerance_px > 0 ? kThinnedDotBytes : kDotBytes) *
                              drawn_dots(dots, view, tolerance_px).size();
    return bytes <= most ? std::optional(bytes) : std::nullopt;
  };
}

/// Sets the tolerances, which are 0 at first.
void limit(std::vector<Limited> shapes, std::size_t most) {
  std::size_t left = most;
  if (std::ranges::all_of(shapes, [&](const Limited& shape) {
        const auto bytes = shape.bytes_of(0, left);
        left -= bytes.value_or(0);
        return bytes.has_value();
      }))
    return;
  const std::size_t share = most / shapes.size();
  left = most;
  std::size_t large = 0;
  for (Limited& shape : shapes) {
    shape.fit(share);
    left -= shape.bytes;
    large += shape.thinned_visibly();
  }
  // What the others leave.
  for (Limited& shape : shapes)
    if (shape.thinned_visibly()) shape.fit(shape.bytes + left / large);
}

}  // namespace

std::optional<std::vector<DrawnLine>> drawn_lines(const FigureLine& line, const PanelView& view,
                                                  double tolerance_px, std::size_t most_points) {
  if (!(tolerance_px > 0)) return whole_lines(line, view);
  PixelLine seen;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    seen.points.emplace_back();
    if (line.points[i]) seen.points.back() = view(*line.points[i]);
    if (!line.shares.empty()) seen.levels.push_back(level_at(line, i));
  }
  auto thinned = thin_line(seen, tolerance_px, seen_area(view), most_points);
  if (!thinned) return std::nullopt;
  std::vector<DrawnLine> drawn;
  for (ThinnedLine& each : *thinned)
    drawn.push_back({stroke_of(line, each.level), std::move(each.stretches)});
  return drawn;
}

std::vector<Vector2d> drawn_dots(const FigureDots& dots, const PanelView& view,
                                 double tolerance_px) {
  std::vector<Vector2d> centres;
  for (const Vector2d& point : dots.points) centres.push_back(view(point));
  return tolerance_px > 0 ? thin_points(centres, tolerance_px) : centres;
}

std::vector<ShapeTolerances> shape_tolerances(const Figure& figure, double detail) {
  std::vector<ShapeTolerances> tolerances;
  std::vector<Limited> lines, dots;
  for (const FigurePanel& panel : figure.panels) tolerances.emplace_back(panel.shapes.size());
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const FigurePanel& panel = figure.panels[p];
    const PanelView view(panel, Vector2d::Zero());
    for (std::size_t i = 0; i < panel.shapes.size(); ++i) {
      if (const auto* line = std::get_if<FigureLine>(&panel.shapes[i]))
        lines.push_back({&tolerances[p][i], bytes_of(*line, view)});
      if (const auto* each = std::get_if<FigureDots>(&panel.shapes[i]))
        dots.push_back({&tolerances[p][i], bytes_of(*each, view)});
    }
  }
  const auto share = [&](std::size_t bytes) {
    return static_cast<std::size_t>(detail * static_cast<double>(bytes));
  };
  limit(std::move(lines), share(kMostLineBytes));
  limit(std::move(dots), share(kMostDotBytes));
  return tolerances;
}

}  // namespace placegraph
