#include <fmt/format.h>
#include <placegraph/eval/internal/plots/label_room.h>
#include <placegraph/eval/internal/plots/plot.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/eval/internal/plots/plot_style.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr int kHeight = 800, kWidth = 1600, kWidthWithoutErrors = 1000;
constexpr Colour kReference = {150, 150, 150}, kLink = {0, 158, 115}, kRejected = {213, 94, 0};
// Colours of Okabe & Ito, which colour-blind readers can distinguish.
constexpr Colour kPalette[] = {{0, 114, 178}, {213, 94, 0},   {204, 121, 167},
                               {230, 159, 0}, {86, 180, 233}, {0, 0, 0}};

Colour palette(int estimate) {
  return kPalette[static_cast<std::size_t>(estimate) % std::size(kPalette)];
}

struct Interval {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  double size() const { return max - min; }
};

// A rectangle of the picture and the part of the plane in it.
struct Panel {
  Vector2d corner, size;
  Interval x, y;

  Vector2d px(double at_x, double at_y) const {
    return {corner[0] + (at_x - x.min) / x.size() * size[0],
            corner[1] + size[1] - (at_y - y.min) / y.size() * size[1]};
  }
};

// 1, 2 or 5 times a power of ten, so that about `count` of them fill the interval.
double nice_step(double size, int count) {
  const double raw = size / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10 * power;
}

void widen(Interval& interval, double size) {
  const double middle = 0.5 * (interval.min + interval.max);
  interval.min = middle - 0.5 * size;
  interval.max = middle + 0.5 * size;
}

// Equal scale on both axes, with a margin of 6 % on every side.
void make_equal(Panel& panel) {
  const double metres_per_px =
      std::max({panel.x.size() / panel.size[0], panel.y.size() / panel.size[1], 1e-9}) * 1.12;
  widen(panel.x, metres_per_px * panel.size[0]);
  widen(panel.y, metres_per_px * panel.size[1]);
}

void draw_axes(PlotCanvas& canvas, const Panel& panel, const std::string& x_label,
               const std::string& y_label, const std::string& heading) {
  canvas.rectangle(panel.corner, panel.size, kWhite, kWhite);
  const double bottom = panel.corner[1] + panel.size[1];
  const double x_step = nice_step(panel.x.size(), 7), y_step = nice_step(panel.y.size(), 7);
  for (double i = std::ceil(panel.x.min / x_step); i * x_step <= panel.x.max; ++i) {
    const double at = panel.px(i * x_step, panel.y.min)[0];
    canvas.line({{at, panel.corner[1]}, {at, bottom}}, kGrid, 1);
    canvas.line({{at, bottom}, {at, bottom + 6}}, kFrame, 1);
    canvas.text({at, bottom + 25}, fmt::format("{:g}", i * x_step + 0.0), kTextPx, kInk,
                TextAnchor::kMiddle);
  }
  for (double i = std::ceil(panel.y.min / y_step); i * y_step <= panel.y.max; ++i) {
    const double at = panel.px(panel.x.min, i * y_step)[1];
    canvas.line({{panel.corner[0], at}, {panel.corner[0] + panel.size[0], at}}, kGrid, 1);
    canvas.line({{panel.corner[0] - 6, at}, {panel.corner[0], at}}, kFrame, 1);
    canvas.text({panel.corner[0] - 11, at + 6}, fmt::format("{:g}", i * y_step + 0.0), kTextPx,
                kInk, TextAnchor::kRight);
  }
  canvas.text({panel.corner[0] + panel.size[0] / 2, bottom + 52}, x_label, kTextPx, kInk,
              TextAnchor::kMiddle);
  canvas.text({panel.corner[0] - 11, panel.corner[1] - 14}, y_label, kTextPx, kInk,
              TextAnchor::kMiddle);
  canvas.text({panel.corner[0] + panel.size[0] / 2, panel.corner[1] - 14}, heading, kTextPx, kInk,
              TextAnchor::kMiddle);
}

void draw_frame(PlotCanvas& canvas, const Panel& panel) {
  const Vector2d a = panel.corner, b = panel.corner + panel.size;
  canvas.line({a, {b[0], a[1]}, b, {a[0], b[1]}, a}, kFrame, 1);
}

// A line with gaps at missing points; points nearer than 0.3 px to the last one are left out.
void draw_with_gaps(PlotCanvas& canvas, const std::vector<std::optional<Vector2d>>& points_px,
                    Colour colour, double width_px) {
  std::vector<Vector2d> run;
  for (std::size_t i = 0; i <= points_px.size(); ++i) {
    const bool here = i < points_px.size() && points_px[i].has_value();
    if (here) {
      const bool last = i + 1 == points_px.size() || !points_px[i + 1];
      if (run.empty() || last || (run.back() - *points_px[i]).norm() > 0.3)
        run.push_back(*points_px[i]);
    } else if (!run.empty()) {
      if (run.size() == 1) run.push_back(run.front() + Vector2d(0.5, 0));
      canvas.line(run, colour, width_px);
      run.clear();
    }
  }
}

struct LegendEntry {
  std::string text;
  Colour colour;
  double width_px;
};

using Points = std::vector<std::optional<Vector2d>>;

// The corner of the panel in which a box covers the fewest of the points [px], and how many.
std::pair<Vector2d, long> best_corner(const Panel& panel, const Vector2d& box,
                                      const std::vector<Points>& lines_px) {
  std::pair<Vector2d, long> best(panel.corner, std::numeric_limits<long>::max());
  const Vector2d room = panel.size - box - Vector2d(20, 20);
  for (const Vector2d& share : {Vector2d(1, 0), Vector2d(0, 0), Vector2d(1, 1), Vector2d(0, 1)}) {
    const Vector2d corner = panel.corner + Vector2d(10, 10) + room.cwiseProduct(share);
    const auto covered = [&](const std::optional<Vector2d>& p) {
      return p && ((*p - corner).array() > -8).all() && ((*p - corner - box).array() < 8).all();
    };
    long count = 0;
    for (const Points& line : lines_px) count += std::count_if(line.begin(), line.end(), covered);
    if (count < best.second) best = {corner, count};
  }
  return best;
}

// Scales the content down so that `height_px` stay free at the top of the panel.
void make_room_on_top(Panel& panel, double height_px) {
  const double factor = panel.size[1] / (panel.size[1] - height_px);
  widen(panel.x, panel.x.size() * factor);
  panel.y.max = panel.y.min + panel.y.size() * factor;
}

void draw_legend(PlotCanvas& canvas, const Vector2d& corner, const Vector2d& size,
                 const std::vector<LegendEntry>& entries) {
  canvas.rectangle(corner, size, kWhite, kGrid);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double y = corner[1] + 22 + 26.0 * static_cast<double>(i);
    canvas.line({{corner[0] + 14, y - 2}, {corner[0] + 48, y - 2}}, entries[i].colour,
                entries[i].width_px);
    canvas.text({corner[0] + 60, y + 4}, entries[i].text, kTextPx, kInk, TextAnchor::kLeft);
  }
}

// The style of every curve, in their order.
std::vector<LegendEntry> styles_of(const Plot& plot) {
  std::vector<LegendEntry> styles;
  int estimate = 0;
  for (const PlotCurve& curve : plot.curves) {
    styles.push_back({curve.name, curve.reference ? kReference : palette(estimate),
                      curve.reference ? 4.0 : 2.0});
    estimate += !curve.reference;
  }
  return styles;
}

std::vector<LegendEntry> legend_of(const Plot& plot) {
  std::vector<LegendEntry> legend;
  for (const LegendEntry& style : styles_of(plot))
    if (std::none_of(legend.begin(), legend.end(),
                     [&](const LegendEntry& entry) { return entry.text == style.text; }))
      legend.push_back(style);
  if (!plot.places_m.empty())
    legend.push_back({fmt::format("{} places", plot.places_m.size()), kInk, 1});
  if (!plot.links_m.empty())
    legend.push_back(
        {fmt::format("{} loop closure{}", plot.links_m.size(), plot.links_m.size() == 1 ? "" : "s"),
         kLink, 1.5});
  if (!plot.rejected_links_m.empty())
    legend.push_back({fmt::format("{} rejected", plot.rejected_links_m.size()), kRejected, 1.5});
  return legend;
}

// The names of the places beside them, where they cover neither a curve nor the legend.
void draw_place_names(PlotCanvas& canvas, const Plot& plot, const Points& places_px,
                      const std::vector<Points>& lines_px, LabelRoom& room) {
  for (const Points& line : lines_px)
    for (std::size_t i = 1; i < line.size(); ++i)
      if (line[i - 1] && line[i]) room.occupy_line(*line[i - 1], *line[i]);
  constexpr double kName_px = 13, kDisc_px = 3;
  for (const auto& place : places_px)
    room.occupy(*place - Vector2d(kDisc_px, kDisc_px), Vector2d(2 * kDisc_px, 2 * kDisc_px));
  for (std::size_t i = 0; i < plot.place_names.size(); ++i) {
    const Vector2d size(canvas.text_width(plot.place_names[i], kName_px), 0.75 * kName_px);
    if (const auto corner = room.place_beside(*places_px[i], size))
      canvas.text(*corner + Vector2d(0, size[1]), plot.place_names[i], kName_px, kInk,
                  TextAnchor::kLeft);
  }
}

// The curve that determines the axes.
const PlotCurve& chooser_of(const Plot& plot) {
  const auto reference = std::find_if(plot.curves.begin(), plot.curves.end(),
                                      [](const PlotCurve& curve) { return curve.reference; });
  return reference != plot.curves.end() ? *reference : plot.curves.front();
}

void draw_top_view(PlotCanvas& canvas, const Plot& plot, Panel panel) {
  const PlotCurve& chooser = chooser_of(plot);
  const auto [horizontal, vertical] = top_view_axes(chooser.positions_m);
  for (const PlotCurve& curve : plot.curves)
    for (const auto& p : curve.positions_m) {
      if (!p) continue;
      panel.x.add((*p)[horizontal]);
      panel.y.add((*p)[vertical]);
    }
  if (!(panel.x.max >= panel.x.min)) panel.x = panel.y = {0, 1};
  make_equal(panel);

  const auto px = [&, h = horizontal, v = vertical](const Eigen::Vector3d& p) {
    return panel.px(p[h], p[v]);
  };
  const auto lines_px = [&] {
    std::vector<Points> lines;
    for (const PlotCurve& curve : plot.curves) {
      lines.emplace_back();
      for (const auto& p : curve.positions_m)
        lines.back().push_back(p ? std::optional<Vector2d>(px(*p)) : std::nullopt);
    }
    return lines;
  };
  const std::vector<LegendEntry> legend = legend_of(plot);
  double width = 0;
  for (const LegendEntry& entry : legend)
    width = std::max(width, canvas.text_width(entry.text, kTextPx));
  const Vector2d box(width + 74, 26.0 * static_cast<double>(legend.size()) + 14);
  if (best_corner(panel, box, lines_px()).second > 0) make_room_on_top(panel, box[1] + 20);

  const auto axis = [&](int which) { return fmt::format("{} [{}]", "xyz"[which], plot.unit); };
  draw_axes(canvas, panel, axis(horizontal), axis(vertical),
            horizontal == 0 ? "top view" : "side view");
  const std::vector<Points> lines = lines_px();
  const std::vector<LegendEntry> styles = styles_of(plot);
  canvas.begin_clip(panel.corner, panel.size);
  for (const bool references : {true, false})
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (plot.curves[i].reference == references)
        draw_with_gaps(canvas, lines[i], styles[i].colour, styles[i].width_px);
  for (const auto& [a, b] : plot.rejected_links_m) canvas.line({px(a), px(b)}, kRejected, 1.5);
  for (const auto& [a, b] : plot.links_m) canvas.line({px(a), px(b)}, kLink, 1.5);
  Points places;
  for (const Eigen::Vector3d& place : plot.places_m) {
    places.emplace_back(px(place));
    canvas.disc(*places.back(), 2.5, kWhite, kInk);
  }
  const auto start = std::find_if(chooser.positions_m.begin(), chooser.positions_m.end(),
                                  [](const auto& p) { return p.has_value(); });
  if (start != chooser.positions_m.end()) canvas.disc(px(**start), 5, kWhite, kInk);
  canvas.end_clip();
  const Vector2d legend_corner = best_corner(panel, box, lines).first;
  LabelRoom room(panel.corner, panel.size);
  room.occupy(legend_corner, box);
  draw_place_names(canvas, plot, places, lines, room);
  draw_legend(canvas, legend_corner, box, legend);
  draw_frame(canvas, panel);
}

void draw_errors(PlotCanvas& canvas, const Plot& plot, Panel panel) {
  panel.x.add(0);
  panel.y.add(0);
  for (const PlotError& error : plot.errors) {
    for (const double d : error.distance_m) panel.x.add(d);
    for (const auto& e : error.error_m)
      if (e) panel.y.add(*e);
  }
  if (!(panel.x.size() > 0)) panel.x.max = 1;
  panel.y.max = panel.y.max > 0 ? 1.08 * panel.y.max : 1;
  draw_axes(canvas, panel, "distance travelled [m]", "[m]", plot.error_label);
  canvas.begin_clip(panel.corner, panel.size);
  for (const PlotError& error : plot.errors) {
    std::vector<std::optional<Vector2d>> points;
    for (std::size_t i = 0; i < error.distance_m.size(); ++i)
      points.push_back(error.error_m[i] ? std::optional<Vector2d>(
                                              panel.px(error.distance_m[i], *error.error_m[i]))
                                        : std::nullopt);
    draw_with_gaps(canvas, points, palette(error.estimate), 2);
  }
  canvas.end_clip();
  draw_frame(canvas, panel);
}

std::string draw(const Plot& plot, PlotCanvas& canvas, int width_px) {
  const double fits = (width_px - 40) / std::max(1.0, canvas.text_width(plot.title, kTitlePx));
  canvas.text({width_px / 2.0, 38}, plot.title, std::min(1.0, fits) * kTitlePx, kInk,
              TextAnchor::kMiddle);
  const double right = plot.errors.empty() ? width_px - 40.0 : 860.0;
  if (!plot.curves.empty())
    draw_top_view(canvas, plot, {{90, 92}, {right - 90, kHeight - 92.0 - 76}, {}, {}});
  if (!plot.errors.empty())
    draw_errors(canvas, plot, {{960, 92}, {width_px - 960.0 - 40, kHeight - 92.0 - 76}, {}, {}});
  return canvas.encode();
}

bool same_truth(const EvaluationResult& a, const EvaluationResult& b) {
  return a.path_m == b.path_m && a.frames == b.frames;
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

Plot plot_of(const std::vector<EvaluationResult>& results) {
  Plot plot;
  const EvaluationResult* last = nullptr;
  int estimate = 0;
  for (const EvaluationResult& r : results) {
    if (!r.outcome) continue;
    PlotCurve truth, curve;
    PlotError error;
    truth.name = "ground truth";
    truth.reference = true;
    curve.name = fmt::format("{}: ATE {:.3g} m", r.name, r.ape.error_m.rmse);
    error.estimate = estimate++;
    error.distance_m = r.travelled_m;
    for (const FramePair& pair : r.aligned_pairs) {
      const Eigen::Vector3d true_m = pair.T_world_truth.translation();
      truth.positions_m.push_back(true_m);
      curve.positions_m.emplace_back();
      error.error_m.emplace_back();
      if (!pair.T_world_estimate) continue;
      curve.positions_m.back() = pair.T_world_estimate->translation();
      error.error_m.back() = (pair.T_world_estimate->translation() - true_m).norm();
    }
    if (!last || !same_truth(*last, r)) plot.curves.push_back(truth);
    plot.curves.push_back(curve);
    plot.errors.push_back(error);
    last = &r;
  }
  if (!last) return plot;
  plot.title = fmt::format("{} of {} frames, {:.1f} m, align {}", last->posed, last->frames,
                           last->path_m, to_string(last->protocol.alignment));
  if (estimate > 1)
    plot.title =
        fmt::format("{} estimates, align {}", estimate, to_string(last->protocol.alignment));
  return plot;
}

std::string to_svg(const Plot& plot) {
  const int width = plot.errors.empty() ? kWidthWithoutErrors : kWidth;
  return draw(plot, *svg_canvas(width, kHeight), width);
}

std::string to_png(const Plot& plot) {
  const int width = plot.errors.empty() ? kWidthWithoutErrors : kWidth;
  return draw(plot, *png_canvas(width, kHeight), width);
}

}  // namespace placegraph
