#include <placegraph/eval/info/motion_steps.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/quantile.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/geometry/trajectory_edit.h>

#include <algorithm>

namespace placegraph {
namespace {

// Half a second is short against a stop and long against the noise of a pose; one second is a stop.
// Two hundredths of the usual motion are none. Chosen.
constexpr double kStandsOver_s = 0.5, kShortestStop_s = 1;
constexpr double kStandsOver_frames = 5, kShortestStop_frames = 10;
constexpr double kStandsShare = 0.02, kUsual = 0.95;

// A step that is five times as fast as those around it would need an acceleration of four times the
// speed within one step. All but one: a single wrong pose makes two such steps. Chosen.
constexpr std::size_t kStepsBeside = 5;
constexpr double kTimesFaster = 5;
// Shorter steps are digits that a file does not have: of the extent of the path, and in degrees.
constexpr double kLeastJumpShare = 1e-4, kLeastJump_deg = 1;

/// The second largest of the speeds of the steps around one, without its own.
double speed_beside(const std::vector<double>& speeds, std::size_t step) {
  const std::size_t begin = step > kStepsBeside ? step - kStepsBeside : 0;
  const std::size_t end = std::min(speeds.size(), step + kStepsBeside + 1);
  double largest = 0, second = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (i == step) continue;
    if (speeds[i] > largest) {
      second = largest;
      largest = speeds[i];
    } else {
      second = std::max(second, speeds[i]);
    }
  }
  return second;
}

}  // namespace

PosedFrames::PosedFrames(const Trajectory& trajectory)
    : has_times(trajectory.has_times), has_orientation(trajectory.has_orientation) {
  const double unit_ns = has_times ? 1e9 : 1;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const StampedPose& pose = trajectory.poses[i];
    if (!pose.T_world_body) continue;
    indices.push_back(i);
    stamps_ns.push_back(pose.stamp_ns);
    times.push_back(static_cast<double>(pose.stamp_ns - stamps_ns.front()) / unit_ns);
    p_world.push_back(pose.T_world_body->translation());
    q_world_body.push_back(Eigen::Quaterniond(pose.T_world_body->linear()).normalized());
  }
  const std::int64_t most_ns = longest_spacing_ns(trajectory);
  for (std::size_t i = 0; i < size(); ++i)
    after_gap.push_back(i > 0 && stamps_ns[i] - stamps_ns[i - 1] > most_ns);
}

FrameSpan PosedFrames::span(std::size_t first, std::size_t last) const {
  return {indices[first], indices[last], stamps_ns[first], stamps_ns[last]};
}

double PosedFrames::distance_m(std::size_t a, std::size_t b) const {
  return (p_world[b] - p_world[a]).norm();
}

double PosedFrames::angle_deg(std::size_t a, std::size_t b) const {
  return has_orientation ? rad_to_deg(q_world_body[a].angularDistance(q_world_body[b])) : 0;
}

std::vector<MotionOver> motions_over(const PosedFrames& frames, double time) {
  std::vector<MotionOver> motions;
  std::size_t to = 0, last_gap = 0;  // the last frame up to `to` behind a gap
  for (std::size_t from = 0; from < frames.size(); ++from) {
    while (to < frames.size() && frames.times[to] - frames.times[from] < time * (1 - 1e-9)) {
      ++to;
      if (to < frames.size() && frames.after_gap[to]) last_gap = to;
    }
    if (to == frames.size()) break;
    if (last_gap <= from) motions.push_back({from, to, frames.times[to] - frames.times[from]});
  }
  return motions;
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {values.size(), values.front(), at(0.05), at(0.5), at(0.95), values.back()};
}

std::vector<FrameSpan> gaps_in(const PosedFrames& frames) {
  std::vector<FrameSpan> gaps;
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames.after_gap[i]) gaps.push_back(frames.span(i - 1, i));
  return gaps;
}

std::vector<FrameSpan> stops_in(const PosedFrames& frames) {
  const double over = frames.has_times ? kStandsOver_s : kStandsOver_frames;
  const double shortest = frames.has_times ? kShortestStop_s : kShortestStop_frames;
  const std::vector<MotionOver> motions = motions_over(frames, over);
  if (motions.empty()) return {};
  std::vector<double> metres, degrees;
  for (const MotionOver& motion : motions) {
    metres.push_back(frames.distance_m(motion.from, motion.to) / motion.time);
    degrees.push_back(frames.angle_deg(motion.from, motion.to) / motion.time);
  }
  const double least_m = kStandsShare * quantile_of(metres, kUsual);
  const double least_deg = kStandsShare * quantile_of(degrees, kUsual);
  std::vector<FrameSpan> stops;
  std::size_t begin = 0, end = 0;
  bool stands = false;
  const auto finish = [&] {
    if (stands && frames.times[end] - frames.times[begin] >= shortest)
      stops.push_back(frames.span(begin, end));
    stands = false;
  };
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (metres[i] > least_m || degrees[i] > least_deg) {
      if (stands && motions[i].from >= end) finish();
      continue;
    }
    if (stands && motions[i].from > end) finish();
    if (!stands) begin = motions[i].from;
    stands = true;
    end = motions[i].to;
  }
  finish();
  return stops;
}

std::vector<ImplausibleStep> jumps_in(const PosedFrames& frames, double extent_m) {
  std::vector<double> metres, degrees;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double time = frames.times[i] - frames.times[i - 1];
    metres.push_back(frames.distance_m(i - 1, i) / time);
    degrees.push_back(frames.angle_deg(i - 1, i) / time);
  }
  std::vector<ImplausibleStep> jumps;
  if (metres.size() < 2 * kStepsBeside) return jumps;
  for (std::size_t i = 0; i < metres.size(); ++i) {
    const double distance_m = frames.distance_m(i, i + 1), angle_deg = frames.angle_deg(i, i + 1);
    const double beside_m = speed_beside(metres, i), beside_deg = speed_beside(degrees, i);
    const bool far = distance_m > kLeastJumpShare * extent_m && metres[i] > kTimesFaster * beside_m;
    const bool turned = angle_deg > kLeastJump_deg && degrees[i] > kTimesFaster * beside_deg;
    if (!far && !turned) continue;
    const double beside = far ? beside_m : beside_deg;
    ImplausibleStep jump{frames.span(i, i + 1), distance_m, angle_deg, std::nullopt};
    if (beside > 0) jump.times_faster = (far ? metres[i] : degrees[i]) / beside;
    jumps.push_back(jump);
  }
  return jumps;
}

}  // namespace placegraph
