#include <fmt/format.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/kitti/kitti_plots.h>

#include <algorithm>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr double kKmhPerMs = 3.6;

const KittiSequence* find_sequence(const KittiSystem& system, const std::string& name) {
  const auto found = std::ranges::find(system.sequences, name, &KittiSequence::name);
  return found == system.sequences.end() ? nullptr : &*found;
}

std::string title_of(const std::string& sequence) {
  return sequence == kKittiAverage ? "All sequences" : "Sequence " + sequence;
}

/// x and z, which a camera that looks forward sees from above.
Vector2d from_above(const Eigen::Isometry3d& T_world_cam) {
  return {T_world_cam.translation().x(), T_world_cam.translation().z()};
}

std::optional<Figure> path_figure(const KittiBenchmark& benchmark, const std::string& name) {
  constexpr double kSide_px = 720;
  Figure figure;
  FigurePanel panel;
  FigureDots start{{}, 5, kWhite, kInk};
  Interval x, z;
  const auto add = [&](FigureLine& line, const Eigen::Isometry3d& T_world_cam) {
    const Vector2d at = from_above(T_world_cam);
    x.add(at.x());
    z.add(at.y());
    line.points.emplace_back(at);
  };
  for (std::size_t i = 0; i < benchmark.systems.size(); ++i) {
    const KittiSequence* sequence = find_sequence(benchmark.systems[i], name);
    if (!sequence || sequence->pairs.empty()) continue;
    FigureLine truth{{}, {kReference, 4}, {}}, estimate{{}, curve_stroke(i), {}};
    for (const FramePair& pair : sequence->pairs) {
      add(truth, pair.T_world_truth);
      if (pair.T_world_estimate) add(estimate, *pair.T_world_estimate);
    }
    if (start.points.empty()) {
      start.points.push_back(from_above(sequence->pairs.front().T_world_truth));
      figure.legend.push_back({"ground truth", truth.stroke});
      panel.shapes.emplace_back(std::move(truth));
    }
    figure.legend.push_back({benchmark.systems[i].name, estimate.stroke});
    panel.shapes.emplace_back(std::move(estimate));
  }
  if (start.points.empty()) return std::nullopt;
  figure.legend.push_back({"start of the sequence", {kInk, 5}, LegendMark::kRing});
  panel.shapes.emplace_back(std::move(start));
  panel.x = {"x [m]", with_margin(x, 0.05, 1), false, {}};
  panel.y = {"z [m]", with_margin(z, 0.05, 1), false, {}};
  panel.corner = {kLeftMargin, kTopMargin};
  panel.size = {kSide_px, kSide_px};
  make_equal(panel);
  figure.title = title_of(name);
  figure.notes = {"poses as they are given, not aligned"};
  figure.width_px = kLeftMargin + kSide_px + kRightMargin;
  figure.height_px = kTopMargin + kSide_px + kBottomMargin;
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// The figures that are drawn of a system; nothing if it does not have them.
const KittiFigures* drawn_figures(const KittiSystem& system, const std::string& name) {
  if (name == kKittiAverage) return &system.mean;
  const KittiSequence* sequence = find_sequence(system, name);
  return sequence ? &sequence->figures : nullptr;
}

/// The point of a row in the units of the server's plots: m or km/h, % or deg/m.
Vector2d point_of(const KittiRow& row, bool over_speed, bool rotation) {
  return {over_speed ? kKmhPerMs * row.at : row.at,
          rotation ? row.r_deg_per_100m / 100 : row.t_percent};
}

std::optional<Figure> error_figure(const KittiBenchmark& benchmark, const std::string& name,
                                   bool over_speed, bool rotation) {
  constexpr double kWidth_px = 640, kHeight_px = 300;
  Figure figure;
  FigurePanel panel;
  Interval along, errors;
  errors.add(0);
  for (std::size_t i = 0; i < benchmark.systems.size(); ++i) {
    const KittiFigures* figures = drawn_figures(benchmark.systems[i], name);
    if (!figures) continue;
    const std::vector<KittiRow>& rows = over_speed ? figures->by_speed : figures->by_length;
    if (rows.empty()) continue;
    const Stroke stroke = curve_stroke(i);
    FigureLine line{{}, stroke, {}};
    FigureDots marks{{}, 4, kWhite, stroke.colour};
    for (const KittiRow& row : rows) {
      marks.points.push_back(point_of(row, over_speed, rotation));
      line.points.emplace_back(marks.points.back());
      along.add(marks.points.back().x());
      errors.add(marks.points.back().y());
    }
    figure.legend.push_back({benchmark.systems[i].name, stroke});
    panel.shapes.emplace_back(std::move(line));
    panel.shapes.emplace_back(std::move(marks));
  }
  if (along.empty()) return std::nullopt;
  panel.x = {
      over_speed ? "speed [km/h]" : "path length [m]", with_margin(along, 0.04, 1), false, {}};
  panel.y = {rotation ? "rotation error [deg/m]" : "translation error [%]",
             {0, with_margin(errors, 0.06).max},
             false,
             {}};
  panel.corner = {kLeftMargin, kTopMargin};
  panel.size = {kWidth_px, kHeight_px};
  figure.title = title_of(name);
  figure.notes = {over_speed ? "means over the segments within 7.2 km/h of each speed"
                             : "means over the segments of each length"};
  figure.width_px = kLeftMargin + kWidth_px + kRightMargin;
  figure.height_px = kTopMargin + kHeight_px + kBottomMargin;
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

const std::vector<std::string>& kitti_plot_names() {
  static const std::vector<std::string> names = {"path", "tl", "rl", "ts", "rs"};
  return names;
}

std::optional<Figure> figure_of(const KittiBenchmark& benchmark, const std::string& sequence,
                                KittiPlot plot) {
  switch (plot) {
    case KittiPlot::kPath:
      return path_figure(benchmark, sequence);
    case KittiPlot::kTranslationOverLength:
      return error_figure(benchmark, sequence, false, false);
    case KittiPlot::kRotationOverLength:
      return error_figure(benchmark, sequence, false, true);
    case KittiPlot::kTranslationOverSpeed:
      return error_figure(benchmark, sequence, true, false);
    case KittiPlot::kRotationOverSpeed:
      return error_figure(benchmark, sequence, true, true);
  }
  return std::nullopt;
}

}  // namespace placegraph
