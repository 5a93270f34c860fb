#include <fmt/format.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// A step that is shorter than the delta by this share is one of that length: sums of a tenth round.
constexpr double kStepRounding = 1e-9;

/// Pairs first..last, inclusive, without a gap between them.
struct Stretch {
  std::size_t first, last;
};

std::vector<Stretch> stretches_of(const std::vector<bool>& gap_before) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < gap_before.size(); ++i) {
    if (gap_before[i])
      stretches.push_back({i, i});
    else
      stretches.back().last = i;
  }
  return stretches;
}

/// How far pair i is from pair i - 1, in the unit of the delta; seconds are found by stamps instead.
double advance(const std::vector<FramePair>& pairs, std::size_t i, Delta::Unit unit) {
  const Eigen::Isometry3d &a = pairs[i - 1].T_world_truth, &b = pairs[i].T_world_truth;
  switch (unit) {
    case Delta::Unit::kMetres:
      return (b.translation() - a.translation()).norm();
    case Delta::Unit::kDegrees:
      return rad_to_deg(rotation_angle(relative_pose(a, b).topLeftCorner<3, 3>()));
    case Delta::Unit::kFrames:
    case Delta::Unit::kSeconds:
      break;
  }
  return 1;
}

/// The ends of steps within one stretch.
class StepEnds {
 public:
  StepEnds(const std::vector<FramePair>& pairs, const Stretch& stretch, const Delta& delta)
      : pairs_(pairs), stretch_(stretch), delta_(delta) {}

  /// The end of the step that begins at `first`, at or after `from`; nothing beyond the stretch.
  /// `done` is how far `from` is from `first`, and is kept up to date.
  std::optional<std::size_t> at_or_beyond(std::size_t from, double& done) const {
    const double enough = delta_.value * (1 - kStepRounding);
    while (done < enough) {
      if (from == stretch_.last) return std::nullopt;
      done += advance(pairs_, ++from, delta_.unit);
    }
    return from;
  }

  /// The pair nearest to the delta in seconds after `first`; `from` is a pair before it.
  std::optional<std::size_t> nearest(std::size_t first, std::size_t from,
                                     double slack_ns) const {
    // Whole nanoseconds: doubles of stamps since 1970 are steps of 256 ns.
    const std::int64_t target_ns = pairs_[first].stamp_ns + std::llround(delta_.value * 1e9);
    const auto late_ns = [&](std::size_t i) {
      return static_cast<double>(pairs_[i].stamp_ns - target_ns);
    };
    std::size_t end = std::max(from, first + 1);
    if (end > stretch_.last) return std::nullopt;
    while (end < stretch_.last && std::abs(late_ns(end + 1)) <= std::abs(late_ns(end))) ++end;
    if (end == stretch_.last && late_ns(end) < -slack_ns) return std::nullopt;
    return end;
  }

 private:
  const std::vector<FramePair>& pairs_;
  const Stretch stretch_;
  const Delta delta_;
};

/// The median spacing of the stamps; 0 for less than two pairs.
double median_spacing_ns(const std::vector<FramePair>& pairs) {
  std::vector<double> spacings_ns;
  spacings_ns.reserve(pairs.size());
  for (std::size_t i = 1; i < pairs.size(); ++i)
    spacings_ns.push_back(static_cast<double>(pairs[i].stamp_ns - pairs[i - 1].stamp_ns));
  return spacings_ns.empty() ? 0 : median_of(std::move(spacings_ns));
}

/// As gaps_before(), of pairs whose median spacing is known.
std::vector<bool> gaps_by_spacing(const std::vector<FramePair>& pairs, double median_ns) {
  std::vector<double> deviations_ns;
  deviations_ns.reserve(pairs.size());
  for (std::size_t i = 1; i < pairs.size(); ++i)
    deviations_ns.push_back(
        std::abs(static_cast<double>(pairs[i].stamp_ns - pairs[i - 1].stamp_ns) - median_ns));
  const double deviation_ns = deviations_ns.empty() ? 0 : median_of(std::move(deviations_ns));
  const double longest_ns = median_ns + std::max(0.5 * median_ns, 10 * deviation_ns);
  std::vector<bool> gaps(pairs.size(), true);
  for (std::size_t i = 1; i < pairs.size(); ++i)
    gaps[i] = !pairs[i - 1].T_world_estimate || !pairs[i].T_world_estimate ||
              static_cast<double>(pairs[i].stamp_ns - pairs[i - 1].stamp_ns) > longest_ns;
  return gaps;
}

/// Divides the rotation of an error, in the axes of the true body, by the vertical of its world.
void divide_rotation(const Eigen::Matrix3d& R_error, const Eigen::Matrix3d& R_world_truth,
                     const Eigen::Vector3d& up, RelativeError& step) {
  const Eigen::Matrix3d in_world = R_world_truth * R_error * R_world_truth.inverse();
  const Eigen::Vector3d moved_up = in_world * up;
  step.heading_deg = rad_to_deg(twist_angle(in_world, up));
  step.inclination_deg = rad_to_deg(std::atan2(up.cross(moved_up).norm(), up.dot(moved_up)));
}

RelativeError error_of_step(const FramePair& a, const FramePair& b, double scale,
                            const std::optional<Eigen::Vector3d>& up) {
  Eigen::Matrix4d T_a_b_estimate = relative_pose(*a.T_world_estimate, *b.T_world_estimate);
  T_a_b_estimate.topRightCorner<3, 1>() *= scale;
  const Eigen::Matrix4d T_a_b_truth = relative_pose(a.T_world_truth, b.T_world_truth);
  const Eigen::Matrix4d error = T_a_b_truth.inverse() * T_a_b_estimate;
  RelativeError step;
  step.translation_m = error.topRightCorner<3, 1>().norm();
  step.rotation_deg = rad_to_deg(rotation_angle(error.topLeftCorner<3, 3>()));
  if (up) divide_rotation(error.topLeftCorner<3, 3>(), b.T_world_truth.linear(), *up, step);
  step.full = (error - Eigen::Matrix4d::Identity()).norm();
  step.length_m = std::abs(T_a_b_truth.topRightCorner<3, 1>().norm() -
                           T_a_b_estimate.topRightCorner<3, 1>().norm());
  return step;
}

/// First and last pair of every step within a stretch.
void add_steps(const std::vector<FramePair>& pairs, const Stretch& stretch, const Delta& delta,
               StepPairs choice, double slack_ns, RelativeErrors& result) {
  const StepEnds ends(pairs, stretch, delta);
  const bool timed = delta.unit == Delta::Unit::kSeconds;
  std::size_t end = stretch.first;
  double done = 0;
  for (std::size_t first = stretch.first; first < stretch.last;) {
    const auto found = timed ? ends.nearest(first, end, slack_ns) : ends.at_or_beyond(end, done);
    if (!found) return;
    end = *found;
    RelativeError step;
    step.first = static_cast<int>(first);
    step.last = static_cast<int>(end);
    result.errors.push_back(step);
    if (choice == StepPairs::kConsecutive) {
      first = end;
      done = 0;
    } else {
      done -= advance(pairs, ++first, delta.unit);
    }
  }
}

/// Why there is no step: how far the drive goes.
Outcome no_step(const std::vector<FramePair>& pairs, const Delta& delta, int gaps) {
  double whole = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    whole += delta.unit == Delta::Unit::kSeconds
                 ? static_cast<double>(pairs[i].stamp_ns - pairs[i - 1].stamp_ns) * 1e-9
                 : advance(pairs, i, delta.unit);
  static constexpr const char* kUnits[] = {"frames", "s", "m", "deg"};
  const char* unit = kUnits[static_cast<int>(delta.unit)];
  if (gaps > 0 && whole >= delta.value)
    return Outcome::failure(Outcome::Code::kTooFewData,
                            fmt::format("none of the {} stretches between gaps is as long as {}",
                                        gaps + 1, text_of(delta)));
  return Outcome::failure(
      Outcome::Code::kTooFewData,
      fmt::format("the drive of {:.6g} {} is too short for steps of {}", whole, unit,
                  text_of(delta)));
}

Statistics of_each(const std::vector<RelativeError>& errors, double RelativeError::* member) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const RelativeError& error : errors) values.push_back(error.*member);
  return statistics_of(values);
}

}  // namespace

void visit(OptionVisitor& field, RelativeErrorOptions& o) {
  const std::string before = to_string(o.deltas);
  std::string deltas = before;
  field("deltas", deltas, "lengths of steps, as 10f,1s,5m,10deg; empty: none");
  if (deltas != before) o.deltas = parse_deltas(deltas);
  field.choice("pairs", o.pairs, {"consecutive", "all"}, "where steps begin");
}

std::vector<bool> gaps_before(const std::vector<FramePair>& pairs) {
  return gaps_by_spacing(pairs, median_spacing_ns(pairs));
}

RelativeErrors relative_errors(const std::vector<FramePair>& pairs, bool has_times,
                               const Delta& delta, StepPairs choice, double scale,
                               const std::optional<Eigen::Vector3d>& up) {
  RelativeErrors result;
  result.delta = delta;
  result.pairs = choice;
  if (delta.unit == Delta::Unit::kSeconds && !has_times) {
    result.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                      "steps of " + text_of(delta) + " need times");
    return result;
  }
  const double spacing_ns = median_spacing_ns(pairs), slack_ns = 0.5 * spacing_ns;
  if (delta.unit == Delta::Unit::kSeconds && delta.value * 1e9 < slack_ns) {
    result.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        fmt::format("steps of {} are shorter than half the spacing of the poses, {:.3g} s",
                    text_of(delta), 1e-9 * spacing_ns));
    return result;
  }
  int stretches = 0;
  for (const Stretch& stretch : stretches_of(gaps_by_spacing(pairs, spacing_ns))) {
    if (!pairs[stretch.first].T_world_estimate) continue;
    ++stretches;
    add_steps(pairs, stretch, delta, choice, slack_ns, result);
  }
  result.gaps = std::max(0, stretches - 1);
  if (result.errors.empty()) {
    result.outcome = no_step(pairs, delta, result.gaps);
    return result;
  }
  for (RelativeError& step : result.errors) {
    const int first = step.first, last = step.last;
    step = error_of_step(pairs[static_cast<std::size_t>(first)],
                         pairs[static_cast<std::size_t>(last)], scale, up);
    step.first = first;
    step.last = last;
  }
  result.translation_m = of_each(result.errors, &RelativeError::translation_m);
  result.rotation_deg = of_each(result.errors, &RelativeError::rotation_deg);
  result.has_vertical = up.has_value();
  if (up) {
    result.heading_deg = of_each(result.errors, &RelativeError::heading_deg);
    result.inclination_deg = of_each(result.errors, &RelativeError::inclination_deg);
  }
  result.full = of_each(result.errors, &RelativeError::full);
  result.length_m = of_each(result.errors, &RelativeError::length_m);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
