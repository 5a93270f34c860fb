#include <fmt/format.h>
#include <placegraph/eval/alignment/alignment.h>
#include <placegraph/eval/alignment/vertical.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Share of the truth's variance that a motion like it explains at least. Chosen.
constexpr double kLeastExplained = 0.1;

/// The positions of the fit and the first pair of them.
struct FittedPositions {
  std::vector<Eigen::Vector3d> from, to;
  const FramePair* first = nullptr;
};

FittedPositions positions_in(const std::vector<FramePair>& pairs, const AlignmentSpan& over) {
  FittedPositions positions;
  double poses = 0;
  std::int64_t begin_ns = 0;
  for (const FramePair& pair : pairs) {
    if (!pair.T_world_estimate) continue;
    if (poses == 0) begin_ns = pair.stamp_ns;
    double place = over.begin;
    if (over.unit == AlignmentSpan::Unit::kFrames) place = pair.frame;
    if (over.unit == AlignmentSpan::Unit::kSeconds)
      place = static_cast<double>(pair.stamp_ns - begin_ns) * 1e-9;
    if (over.unit == AlignmentSpan::Unit::kPoses) place = poses;
    ++poses;
    if (place < over.begin || place >= over.end) continue;
    if (!positions.first) positions.first = &pair;
    positions.from.push_back(pair.T_world_estimate->translation());
    positions.to.push_back(pair.T_world_truth.translation());
  }
  return positions;
}

Outcome too_few(std::size_t have, std::size_t need) {
  return Outcome::failure(
      Outcome::Code::kTooFewData,
      fmt::format("{} associated poses, the alignment needs {}", have, need));
}

double rmse_of(const AlignmentResult& a, const FittedPositions& positions) {
  double squares = 0;
  for (std::size_t i = 0; i < positions.from.size(); ++i)
    squares += (positions.to[i] -
                (a.scale * (a.R_truth_estimate * positions.from[i]) + a.t_truth_estimate))
                   .squaredNorm();
  return std::sqrt(squares / static_cast<double>(positions.from.size()));
}

Eigen::Vector3d mean_position(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

AlignmentResult align_first_pose(const FittedPositions& positions, bool with_scale) {
  AlignmentResult result;
  const std::vector<Eigen::Vector3d>&from = positions.from, &to = positions.to;
  const Eigen::Isometry3d& T_world_truth = positions.first->T_world_truth;
  const Eigen::Isometry3d& T_world_estimate = *positions.first->T_world_estimate;
  if (T_world_truth.linear() != T_world_estimate.linear())
    result.R_truth_estimate = T_world_truth.linear() * T_world_estimate.linear().inverse();
  result.outcome = Outcome::ok();
  if (with_scale) {
    double along = 0, squares = 0;
    // What both have in common is computed about their means: the noise of the first pose is in every
    // displacement from it.
    const Eigen::Vector3d mean_from = mean_position(from), mean_to = mean_position(to);
    double common = 0, variance_from = 0, variance_to = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Eigen::Vector3d moved = result.R_truth_estimate * (from[i] - from[0]);
      along += moved.dot(to[i] - to[0]);
      squares += moved.squaredNorm();
      common += (result.R_truth_estimate * (from[i] - mean_from)).dot(to[i] - mean_to);
      variance_from += (from[i] - mean_from).squaredNorm();
      variance_to += (to[i] - mean_to).squaredNorm();
    }
    if (variance_from > 0 && variance_to > 0)
      result.explained = common * common / (variance_from * variance_to);
    if (squares > 0 && along > 0)
      result.scale = along / squares;
    else
      result.outcome = Outcome::failure(
          Outcome::Code::kDegenerate,
          squares > 0 ? "the fitted scale is not positive" : "the estimate never moves: no scale");
  }
  result.t_truth_estimate = to[0] - result.scale * (result.R_truth_estimate * from[0]);
  return result;
}

/// Rotation about the vertical and translation, least squares of the positions.
AlignmentResult align_yaw(const FittedPositions& positions, const Eigen::Vector3d& axis) {
  AlignmentResult result;
  const Eigen::Vector3d mean_from = mean_position(positions.from),
                        mean_to = mean_position(positions.to);
  double cosine = 0, sine = 0, level_m2 = 0, all_m2 = 0;
  for (std::size_t i = 0; i < positions.from.size(); ++i) {
    const Eigen::Vector3d from = positions.from[i] - mean_from, to = positions.to[i] - mean_to;
    cosine += from.dot(to) - axis.dot(from) * axis.dot(to);
    sine += axis.dot(from.cross(to));
    level_m2 += axis.cross(to).squaredNorm() + axis.cross(from).squaredNorm();
    all_m2 += mean_to.squaredNorm() + mean_from.squaredNorm() + to.squaredNorm();
  }
  // Rounding of coordinates of that size. Chosen.
  if (level_m2 <= 1e-24 * all_m2) {
    result.outcome = Outcome::failure(
        Outcome::Code::kDegenerate,
        "the positions do not move across the vertical: the heading is not determined");
    return result;
  }
  result.R_truth_estimate = Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
  result.t_truth_estimate = mean_to - result.R_truth_estimate * mean_from;
  const double moved_m = rmse_of(result, positions);
  if (rmse_of({}, positions) <= moved_m) result = {};
  result.outcome = Outcome::ok();
  return result;
}

/// Whether the two motions have so little in common that a scale between them means nothing.
///
/// White noise explains 3 / n of the variance of n poses, and a few poses of it much more.
/// A scale about the first pose has no rotation to fit, and noise explains less.
bool unrelated(const AlignmentResult& result, Alignment alignment) {
  constexpr double kNoise = 12, kMost = 0.5;  // chosen
  if (alignment == Alignment::kScale) return result.explained < kLeastExplained;
  return alignment == Alignment::kSim3 &&
         result.explained < std::clamp(kNoise / result.pairs, kLeastExplained, kMost);
}

/// Names what the positions do not determine.
void add_doubts(Alignment alignment, const FittedPositions& positions,
                const Eigen::Vector3d& vertical_axis, AlignmentResult& result) {
  const bool free_rotation = alignment == Alignment::kSe3 || alignment == Alignment::kSim3;
  if (!free_rotation && alignment != Alignment::kYaw) return;
  // Errors vary slowly along a drive, so that only a handful of them are independent: the rotation
  // about an axis has a deviation of 0.1 rad if the spread about it is five times the error. Chosen.
  constexpr double kSpreadPerError = 5;
  const PositionSpread spread = spread_of(positions.to);
  const double error_m = result.rmse_m / std::sqrt(3.0);
  if (free_rotation && result.rank > 1 &&
      std::sqrt(spread.variances_m2[1]) < kSpreadPerError * error_m)
    result.free_axes = {spread.axes.col(2)};
  if (alignment == Alignment::kYaw) {
    const Eigen::Vector3d level = spread.axes.transpose() * vertical_axis;
    double level_m2 = 0;
    for (int i = 0; i < 3; ++i) level_m2 += spread.variances_m2[i] * (1 - level[i] * level[i]);
    if (std::sqrt(level_m2) < kSpreadPerError * error_m) result.free_axes = {vertical_axis};
  }
  if (free_rotation && result.rank > 1 && result.explained < kLeastExplained) {
    result.free_axes = {spread.axes.col(2)};
    result.doubts.push_back(fmt::format(
        "the rotation is arbitrary: the estimate's motion explains {:.1f} % of the ground truth's, "
        "as one that stands within its noise would",
        100 * result.explained));
  } else if (!result.free_axes.empty()) {
    const Eigen::Vector3d& a = result.free_axes.front();
    const char* what = alignment == Alignment::kYaw
                           ? "the positions do not show the heading"
                           : "the positions lie on a line";
    result.doubts.push_back(fmt::format(
        "{}{}: the rotation about ({:.3f}, {:.3f}, {:.3f}) is arbitrary "
        "(the ATE does not depend on it)",
        what, result.rank == 1 ? "" : " within their errors", a[0], a[1], a[2]));
  }
  if (result.mirrored)
    result.doubts.emplace_back(
        "the estimate looks like a mirror image: a reflection would at least halve the error");
  const int numbers = alignment == Alignment::kSim3 ? 7 : alignment == Alignment::kSe3 ? 6 : 4;
  if (result.pairs < numbers)
    result.doubts.push_back(fmt::format(
        "the alignment fits {} numbers to {} poses, which makes the error small", numbers,
        result.pairs));
}

AlignmentResult fit(const FittedPositions& positions, Alignment alignment,
                    const Eigen::Vector3d& vertical_axis) {
  AlignmentResult result;
  switch (alignment) {
    case Alignment::kNone:
      result.outcome = Outcome::ok();
      return result;
    case Alignment::kOrigin:
      return align_first_pose(positions, false);
    case Alignment::kScale:
      return align_first_pose(positions, true);
    case Alignment::kSe3:
      return umeyama(positions.from, positions.to, false);
    case Alignment::kSim3:
      return umeyama(positions.from, positions.to, true);
    case Alignment::kYaw:
      return align_yaw(positions, vertical_axis);
  }
  throw ArgumentError("unknown alignment");
}

}  // namespace

AlignmentResult align(const std::vector<FramePair>& pairs, Alignment alignment,
                      const AlignmentSpan& over, const Eigen::Vector3d& vertical_axis) {
  const FittedPositions positions = positions_in(pairs, over);
  const std::size_t needed =
      alignment == Alignment::kScale || alignment == Alignment::kYaw ? 2 : 1;
  AlignmentResult result;
  if (positions.from.size() < needed) {
    result.outcome = too_few(positions.from.size(), needed);
    return result;
  }
  result = fit(positions, alignment, vertical_axis);
  result.pairs = static_cast<int>(positions.from.size());
  result.rmse_m = rmse_of(result, positions);
  if (!result.outcome && result.rank != 1) return result;
  if (unrelated(result, alignment)) {
    result.rank = 0;
    result.outcome = Outcome::failure(
        Outcome::Code::kDegenerate,
        fmt::format("the scale is free: the estimate's motion explains {:.1f} % of the ground "
                    "truth's, as one that stands within its noise would (fitted scale {:.4g})",
                    100 * result.explained, result.scale));
    return result;
  }
  add_doubts(alignment, positions, vertical_axis, result);
  return result;
}

}  // namespace placegraph
