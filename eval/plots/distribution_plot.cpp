#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/drawing/text_width.h>
#include <placegraph/eval/plots/distribution_plot.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

using Eigen::Vector2d;

/// The value below which a share of the sorted values lies, between neighbours in proportion.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<double> sorted_values(const Sample& sample) {
  require(!sample.values.empty(), "distribution plot: '" + sample.name + "' has no values");
  std::vector<double> sorted = sample.values;
  std::ranges::sort(sorted);
  return sorted;
}

FigureArea bar(double from, double to, double row, double half, Colour colour, double opacity) {
  return {{{{from, row - half}, {to, row - half}, {to, row + half}, {from, row + half}}},
          colour,
          opacity};
}

FigureLine stroke_from(const Vector2d& a, const Vector2d& b, Colour colour, double width_px) {
  return {{a, b}, {colour, width_px}, {}};
}

/// Names the sample in those of its shapes that have its colour.
void name_series(const std::string& name, Colour colour, std::size_t first,
                 std::vector<FigureShape>& shapes) {
  for (std::size_t i = first; i < shapes.size(); ++i) {
    if (auto* line = std::get_if<FigureLine>(&shapes[i]); line && line->stroke.colour == colour)
      line->series = name;
    if (auto* dots = std::get_if<FigureDots>(&shapes[i]); dots && dots->edge == colour)
      dots->series = name;
    if (auto* area = std::get_if<FigureArea>(&shapes[i]); area && area->fill == colour)
      area->series = name;
  }
}

/// A row for every sample, and shapes in it.
template <typename Draw>
void draw_rows(const std::vector<Sample>& samples, const std::string& label, const Draw& draw,
               Figure& figure) {
  constexpr double kWidth_px = 760, kRow_px = 58, kMostName_px = 560;
  FigurePanel panel;
  Interval values;
  values.add(0);
  double name_px = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::vector<double> sorted = sorted_values(samples[i]);
    values.add(sorted.back());
    panel.y.categories.push_back(fitted(samples[i].name, kTickPx, kMostName_px));
    name_px = std::max(name_px, text_width(panel.y.categories.back(), kTickPx));
    const std::size_t first = panel.shapes.size();
    draw(sorted, static_cast<double>(i), curve_stroke(i).colour, panel.shapes);
    name_series(samples[i].name, curve_stroke(i).colour, first, panel.shapes);
  }
  panel.x = {label, {0, std::max(1.04 * values.max, kLeastError)}, false, {}};
  const double rows = static_cast<double>(samples.size());
  panel.y.range = {-0.5, rows - 0.5};
  panel.corner = {name_px + 36, 14};
  panel.size = {kWidth_px, kRow_px * rows};
  figure.width_px = panel.corner[0] + kWidth_px + kRightMargin;
  figure.height_px = 14 + panel.size[1] + kBottomMargin;
  figure.panels.push_back(std::move(panel));
}

/// Density of the sorted values at points from the least to the largest.
std::vector<Vector2d> density_of(const std::vector<double>& sorted) {
  constexpr int kPoints = 120;
  const auto count = static_cast<double>(sorted.size());
  const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
  double squares = 0;
  for (const double value : sorted) squares += (value - mean) * (value - mean);
  const double sigma = std::sqrt(squares / count),
               spread = (quantile(sorted, 0.75) - quantile(sorted, 0.25)) / 1.34;
  const double range = sorted.back() - sorted.front();
  const double width =
      std::max(0.9 * (spread > 0 ? std::min(sigma, spread) : sigma) * std::pow(count, -0.2),
               std::max(range / kPoints, 1e-12));
  std::vector<Vector2d> density;
  for (int i = 0; i <= kPoints; ++i) {
    const double at = sorted.front() + range * i / kPoints;
    // Values beyond five widths add nothing.
    const auto begin = std::ranges::lower_bound(sorted, at - 5 * width),
               end = std::ranges::upper_bound(sorted, at + 5 * width);
    double sum = 0;
    for (auto value = begin; value != end; ++value)
      sum += std::exp(-0.5 * std::pow((*value - at) / width, 2));
    density.emplace_back(at, sum);
  }
  return density;
}

}  // namespace

void draw_boxes(const std::vector<Sample>& samples, const std::string& label, Figure& figure) {
  figure.notes.emplace_back(
      "box: quartiles and median; whiskers: within 1.5 times the box; disc: maximum");
  draw_rows(
      samples, label,
      [](const std::vector<double>& sorted, double row, Colour colour,
         std::vector<FigureShape>& shapes) {
        constexpr double kHalf = 0.27;
        const double low = quantile(sorted, 0.25), high = quantile(sorted, 0.75),
                     median = quantile(sorted, 0.5), reach = 1.5 * (high - low);
        const double first = *std::ranges::lower_bound(sorted, low - reach),
                     last = *(std::ranges::upper_bound(sorted, high + reach) - 1);
        shapes.emplace_back(stroke_from({first, row}, {low, row}, colour, 1.5));
        shapes.emplace_back(stroke_from({high, row}, {last, row}, colour, 1.5));
        for (const double end : {first, last})
          shapes.emplace_back(stroke_from({end, row - 0.12}, {end, row + 0.12}, colour, 1.5));
        shapes.emplace_back(bar(low, high, row, kHalf, colour, 0.35));
        for (const double side : {-kHalf, kHalf})
          shapes.emplace_back(stroke_from({low, row + side}, {high, row + side}, colour, 1.5));
        for (const double end : {low, high})
          shapes.emplace_back(stroke_from({end, row - kHalf}, {end, row + kHalf}, colour, 1.5));
        shapes.emplace_back(stroke_from({median, row - kHalf}, {median, row + kHalf}, kInk, 2.5));
        shapes.emplace_back(FigureDots{{{sorted.back(), row}}, 3, colour, colour});
      },
      figure);
}

void draw_violins(const std::vector<Sample>& samples, const std::string& label, Figure& figure) {
  figure.notes.emplace_back("width: density of the errors; bar: quartiles; ring: median");
  draw_rows(
      samples, label,
      [](const std::vector<double>& sorted, double row, Colour colour,
         std::vector<FigureShape>& shapes) {
        const std::vector<Vector2d> density = density_of(sorted);
        double most = 0;
        for (const Vector2d& p : density) most = std::max(most, p[1]);
        std::vector<Vector2d> ring;
        for (const Vector2d& p : density) ring.emplace_back(p[0], row - 0.42 * p[1] / most);
        for (auto p = density.rbegin(); p != density.rend(); ++p)
          ring.emplace_back((*p)[0], row + 0.42 * (*p)[1] / most);
        std::vector<std::optional<Vector2d>> outline(ring.begin(), ring.end());
        outline.emplace_back(ring.front());
        shapes.emplace_back(FigureArea{{ring}, colour, 0.4});
        shapes.emplace_back(FigureLine{std::move(outline), {colour, 1.2}, {}});
        shapes.emplace_back(
            bar(quantile(sorted, 0.25), quantile(sorted, 0.75), row, 0.05, kInk, 1));
        shapes.emplace_back(FigureDots{{{quantile(sorted, 0.5), row}}, 4, kWhite, kInk});
      },
      figure);
}

}  // namespace placegraph
