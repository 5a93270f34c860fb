#include <placegraph/eval/drawing/plot_axis.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/evaluation_series.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Series = std::vector<std::optional<Vector2d>>;

constexpr double kWidth_px = 1000, kHeight_px = 190;

/// A panel below the others, over the x of its series.
void add_panel(FigureAxis x, const std::string& y_label, std::vector<FigureShape> lines,
               bool from_zero, Figure& figure) {
  Interval along, values;
  for (const FigureShape& shape : lines)
    if (const auto* line = std::get_if<FigureLine>(&shape))
      for (const auto& p : line->points)
        if (p) along.add((*p)[0]), values.add((*p)[1]);
  if (from_zero) values.add(0);
  FigurePanel panel;
  panel.x = std::move(x);
  panel.x.range = with_margin(along, 0);
  panel.y = {y_label, with_margin(values, 0.05), false, {}};
  if (from_zero) panel.y.range.min = 0;
  panel.shapes = std::move(lines);
  panel.corner = {kLeftMargin, figure.height_px + 16};
  panel.size = {kWidth_px, kHeight_px};
  figure.panels.push_back(std::move(panel));
  figure.width_px = kLeftMargin + kWidth_px + kRightMargin;
  figure.height_px += 16 + kHeight_px + kBottomMargin;
}

double time_of(const EvaluationResult& result, std::int64_t begin_ns, const FramePair& pair) {
  return result.has_times ? 1e-9 * static_cast<double>(pair.stamp_ns - begin_ns) : pair.frame;
}

/// Adds multiples of 360 degrees so that neighbours differ by at most 180.
void unwrap(Series& series) {
  std::optional<double> last;
  for (auto& p : series) {
    if (!p) continue;
    if (last) (*p)[1] += 360 * std::round((*last - (*p)[1]) / 360);
    last = (*p)[1];
  }
}

/// Adds multiples of 360 degrees so that no value differs from the reference by more than 180.
void unwrap(Series& series, const Series& reference) {
  for (std::size_t i = 0; i < series.size(); ++i)
    if (series[i])
      (*series[i])[1] += 360 * std::round(((*reference[i])[1] - (*series[i])[1]) / 360);
}

LegendEntry series_entry(const std::string& name, const Stroke& stroke) {
  return {name, stroke, LegendMark::kLine, name};
}

/// Three values of a pose, and how they are drawn.
struct PoseValues {
  const char* labels[3];
  Vector3d (*of)(const Eigen::Isometry3d& pose);
  bool angles;
};

/// A value of the true and of the estimated poses over time, or over the frames of the truth.
std::pair<Series, Series> series_of(const EvaluationResult& result, bool timed,
                                    std::int64_t begin_ns, const PoseValues& values, int row) {
  Series truth, estimate;
  for (const FramePair& pair : result.aligned_pairs) {
    const double at = timed ? time_of(result, begin_ns, pair) : pair.frame;
    truth.emplace_back(Vector2d(at, values.of(pair.T_world_truth)[row]));
    estimate.emplace_back();
    if (pair.T_world_estimate)
      estimate.back() = Vector2d(at, values.of(*pair.T_world_estimate)[row]);
  }
  if (values.angles) {
    unwrap(truth);
    unwrap(estimate, truth);
  }
  return {std::move(truth), std::move(estimate)};
}

/// The frames of both trajectories over time, a panel for each of three values.
void draw_over_time(const std::vector<EvaluationResult>& results, const PoseValues& values,
                    Figure& figure) {
  // An estimate without times is paired by the numbers of frames: then all are drawn over these.
  const bool timed = std::ranges::all_of(results, &EvaluationResult::has_times);
  const FigureAxis x{timed ? "time [s]" : "frame", {}, false, {}};
  std::int64_t begin_ns = results.front().aligned_pairs.front().stamp_ns;
  std::size_t longest = 0;  // its truth is drawn: others may have fewer frames of it
  for (std::size_t r = 0; r < results.size(); ++r) {
    begin_ns = std::min(begin_ns, results[r].aligned_pairs.front().stamp_ns);
    if (results[r].aligned_pairs.size() > results[longest].aligned_pairs.size()) longest = r;
  }
  const Stroke truth_stroke{kReference, 4};
  for (int row = 0; row < 3; ++row) {
    std::vector<FigureShape> lines = {FigureLine{{}, truth_stroke, {}, "ground truth"}};
    for (std::size_t r = 0; r < results.size(); ++r) {
      auto [truth, estimate] = series_of(results[r], timed, begin_ns, values, row);
      if (r == longest) std::get<FigureLine>(lines.front()).points = std::move(truth);
      lines.emplace_back(
          FigureLine{std::move(estimate), curve_stroke(r), {}, plot_name(results[r].name)});
    }
    add_panel(x, values.labels[row], std::move(lines), false, figure);
  }
  figure.legend.push_back({"ground truth", truth_stroke, LegendMark::kLine, "ground truth"});
  for (std::size_t r = 0; r < results.size(); ++r)
    figure.legend.push_back(series_entry(plot_name(results[r].name), curve_stroke(r)));
}

/// Angles about x, y and z, R = Rz(yaw) Ry(pitch) Rx(roll) [deg].
Vector3d roll_pitch_yaw_deg(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  return {rad_to_deg(std::atan2(R(2, 1), R(2, 2))),
          rad_to_deg(std::asin(std::clamp(-R(2, 0), -1.0, 1.0))),
          rad_to_deg(std::atan2(R(1, 0), R(0, 0)))};
}

}  // namespace

std::string plot_name(const std::string& name) {
  for (const char* ending : {".txt", ".tum", ".kitti", ".csv"})
    if (name.ends_with(ending) && name.size() > std::string(ending).size())
      return name.substr(0, name.size() - std::string(ending).size());
  return name;
}

void draw_coordinates(const std::vector<EvaluationResult>& results, Figure& figure) {
  draw_over_time(results,
                 {{"x [m]", "y [m]", "z [m]"},
                  [](const Eigen::Isometry3d& T) -> Vector3d { return T.translation(); },
                  false},
                 figure);
}

void draw_angles(const std::vector<EvaluationResult>& results, Figure& figure) {
  draw_over_time(results, {{"roll [deg]", "pitch [deg]", "yaw [deg]"}, roll_pitch_yaw_deg, true},
                 figure);
  figure.notes.emplace_back("R = Rz(yaw) Ry(pitch) Rx(roll)");
}

void draw_relative_errors(const std::vector<EvaluationResult>& results, Figure& figure) {
  std::vector<FigureShape> translations, rotations;
  for (std::size_t r = 0; r < results.size(); ++r) {
    Stroke stroke = curve_stroke(r);
    stroke.width_px = 1.2;
    Series translation, rotation;
    const std::vector<FramePair>& pairs = results[r].aligned_pairs;
    for (std::size_t i = 1; i < pairs.size(); ++i) {
      translation.emplace_back();
      rotation.emplace_back();
      const FramePair &a = pairs[i - 1], &b = pairs[i];
      if (!a.T_world_estimate || !b.T_world_estimate) continue;
      const Eigen::Matrix4d error = relative_pose(a.T_world_truth, b.T_world_truth).inverse() *
                                    relative_pose(*a.T_world_estimate, *b.T_world_estimate);
      const double at = results[r].travelled_m[i];
      translation.back() = Vector2d(at, error.topRightCorner<3, 1>().norm());
      rotation.back() = Vector2d(at, rad_to_deg(rotation_angle(error.topLeftCorner<3, 3>())));
    }
    translations.emplace_back(
        FigureLine{std::move(translation), stroke, {}, plot_name(results[r].name)});
    rotations.emplace_back(FigureLine{std::move(rotation), stroke, {}, plot_name(results[r].name)});
    figure.legend.push_back(series_entry(plot_name(results[r].name), curve_stroke(r)));
  }
  const FigureAxis x{"distance travelled [m]", {}, false, {}};
  add_panel(x, "translation [m]", std::move(translations), true, figure);
  add_panel(x, "rotation [deg]", std::move(rotations), true, figure);
}

void draw_lengths(const std::vector<EvaluationResult>& results, Figure& figure) {
  std::vector<FigureShape> translations, rotations;
  bool any = false;
  for (std::size_t r = 0; r < results.size(); ++r) {
    const Stroke stroke = curve_stroke(r);
    const std::string name = plot_name(results[r].name);
    FigureLine translation{{}, stroke, {}, name}, rotation{{}, stroke, {}, name};
    FigureDots marks[2] = {{{}, 4, kWhite, stroke.colour, name},
                           {{}, 4, kWhite, stroke.colour, name}};
    for (const SegmentGroup& group : results[r].segments.by_length) {
      marks[0].points.emplace_back(group.from, group.t_percent);
      marks[1].points.emplace_back(group.from, group.r_deg_per_100m);
      translation.points.emplace_back(marks[0].points.back());
      rotation.points.emplace_back(marks[1].points.back());
      any = true;
    }
    translations.emplace_back(std::move(translation));
    translations.emplace_back(std::move(marks[0]));
    rotations.emplace_back(std::move(rotation));
    rotations.emplace_back(std::move(marks[1]));
    figure.legend.push_back(series_entry(name, stroke));
  }
  require(any, "plot of lengths: no path is as long as a segment (--lengths chooses others)");
  const FigureAxis x{"length of the segments [m]", {}, false, {}};
  add_panel(x, "t_rel [%]", std::move(translations), true, figure);
  add_panel(x, "r_rel [deg/100 m]", std::move(rotations), true, figure);
  for (FigurePanel& panel : figure.panels) panel.x.range = with_margin(panel.x.range, 0.04, 1);
}

}  // namespace placegraph
