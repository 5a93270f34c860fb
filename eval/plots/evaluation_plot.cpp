#include <fmt/format.h>
#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/plots/distribution_plot.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/plots/evaluation_series.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

/// The results with outcomes.
std::vector<EvaluationResult> drawable(const std::vector<EvaluationResult>& results) {
  std::vector<EvaluationResult> good;
  for (const EvaluationResult& result : results)
    if (result.outcome) good.push_back(result);
  return good;
}

/// A result's curve and error, its truth before them.
void add_curves(const EvaluationResult& r, const std::string& name, bool with_truth, Plot& plot) {
  PlotCurve truth{"ground truth", {}, true}, curve{name, {}};
  PlotError error;
  error.estimate = static_cast<int>(plot.errors.size());
  error.distance_m = r.travelled_m;
  for (const FramePair& pair : r.aligned_pairs) {
    const Eigen::Vector3d true_m = pair.T_world_truth.translation();
    truth.positions_m.emplace_back(true_m);
    curve.positions_m.emplace_back();
    error.error_m.emplace_back();
    if (r.has_times)
      error.time_s.push_back(1e-9 *
                             static_cast<double>(pair.stamp_ns - r.aligned_pairs.front().stamp_ns));
    if (!pair.T_world_estimate) continue;
    curve.positions_m.back() = pair.T_world_estimate->translation();
    error.error_m.back() = (pair.T_world_estimate->translation() - true_m).norm();
  }
  truth.series = "ground truth";
  curve.series = plot_name(r.name);
  if (with_truth) plot.curves.push_back(std::move(truth));
  plot.curves.push_back(std::move(curve));
  plot.errors.push_back(std::move(error));
}

void colour_by_error(Plot& plot) {
  for (PlotCurve& curve : plot.curves) {
    if (curve.reference) continue;
    curve.width_px = 3;
    for (const auto& error : plot.errors.front().error_m)
      curve.error_m.push_back(error.value_or(0));
  }
}

std::vector<std::string> ate_texts(const std::vector<EvaluationResult>& results) {
  std::vector<double> ates;
  for (const EvaluationResult& r : results) ates.push_back(r.ape.error_m.rmse);
  return comparable(ates);
}

std::string frames_text(const EvaluationResult& r) {
  return fmt::format("{} of {} frames, {:.{}f} m", r.posed, r.frames, r.path_m,
                     r.path_m < 10 ? 2 : 1);
}

Figure sequences_figure(const std::vector<EvaluationResult>& results) {
  const std::vector<std::string> ates = ate_texts(results);
  std::vector<Plot> sequences;
  for (std::size_t i = 0; i < results.size(); ++i) {
    Plot& plot = sequences.emplace_back();
    add_curves(results[i], "estimate", true, plot);
    plot.title = fmt::format("{}: ATE {} m", plot_name(results[i].name), ates[i]);
  }
  return figure_of(sequences, fmt::format("{} sequences", results.size()),
                   {alignment_text(results.front().protocol.alignment)});
}

std::vector<Sample> position_errors(const std::vector<EvaluationResult>& results) {
  std::vector<Sample> samples;
  for (const EvaluationResult& result : results)
    samples.push_back({plot_name(result.name), result.ape.frame_errors_m});
  return samples;
}

std::string title_of(EvaluationPlot kind) {
  switch (kind) {
    case EvaluationPlot::kXyz:
      return "Positions over time";
    case EvaluationPlot::kRpy:
      return "Orientations over time";
    case EvaluationPlot::kRpe:
      return "Errors of the motion between consecutive frames";
    case EvaluationPlot::kLengths:
      return "Mean errors of segments by their length (KITTI)";
    default:
      return "Position errors";
  }
}

}  // namespace

const std::vector<std::string>& evaluation_plot_names() {
  static const std::vector<std::string> names = {"overview", "xyz", "rpy",   "rpe",
                                                 "lengths",  "box", "violin"};
  return names;
}

std::string alignment_text(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "not aligned (none)";
    case Alignment::kOrigin:
      return "aligned by the first pose (origin)";
    case Alignment::kSe3:
      return "aligned by rotation and translation (se3)";
    case Alignment::kSim3:
      return "aligned by rotation, translation and scale (sim3)";
    case Alignment::kScale:
      return "aligned by the first pose and a scale (scale)";
    case Alignment::kYaw:
      return "aligned by translation and heading (yaw)";
  }
  return to_string(alignment);
}

Plot plot_of(const std::vector<EvaluationResult>& results) {
  Plot plot;
  const std::vector<EvaluationResult> good = drawable(results);
  if (good.empty()) return plot;
  const std::vector<std::string> ates = ate_texts(good);
  // One truth for all, of which an estimate with fewer poses may have fewer frames.
  const auto longest = std::ranges::max_element(
      good, {}, [](const EvaluationResult& r) { return r.aligned_pairs.size(); });
  for (auto r = good.begin(); r != good.end(); ++r)
    add_curves(*r,
               fmt::format("{}: ATE {} m", plot_name(r->name),
                           ates[static_cast<std::size_t>(r - good.begin())]),
               r == longest, plot);
  if (good.size() == 1) colour_by_error(plot);
  plot.title =
      good.size() == 1 ? frames_text(good.front()) : fmt::format("{} estimates", good.size());
  plot.notes = {alignment_text(good.front().protocol.alignment)};
  return plot;
}

Figure figure_of(const std::vector<EvaluationResult>& results, EvaluatedTruth truth,
                 EvaluationPlot kind, const std::optional<GroundPicture>& ground) {
  const std::vector<EvaluationResult> good = drawable(results);
  require(!good.empty(), "plot: no estimate was evaluated");
  const bool several = truth == EvaluatedTruth::kOwn && good.size() > 1;
  require(!ground || (kind == EvaluationPlot::kOverview && !several),
          "plot: a map is drawn under the overview of one sequence");
  if (kind == EvaluationPlot::kOverview) {
    if (several) return sequences_figure(good);
    Plot plot = plot_of(good);
    plot.ground = ground;
    return figure_of(plot);
  }
  Figure figure;
  figure.title = title_of(kind);
  figure.notes = {alignment_text(good.front().protocol.alignment)};
  switch (kind) {
    case EvaluationPlot::kXyz:
    case EvaluationPlot::kRpy:
      require(!several, "plot: " + evaluation_plot_names()[static_cast<std::size_t>(kind)] +
                            " is drawn of one sequence at a time");
      (kind == EvaluationPlot::kXyz ? draw_coordinates : draw_angles)(good, figure);
      break;
    case EvaluationPlot::kRpe:
      draw_relative_errors(good, figure);
      break;
    case EvaluationPlot::kLengths:
      draw_lengths(good, figure);
      break;
    case EvaluationPlot::kBox:
      draw_boxes(position_errors(good), "position error [m]", figure);
      break;
    default:
      draw_violins(position_errors(good), "position error [m]", figure);
      break;
  }
  return figure;
}

}  // namespace placegraph
