#include <placegraph/eval/errors/kitti_segments.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace placegraph {
namespace {

double acos_of_trace(const Eigen::Matrix3d& R) {
  return std::acos(std::clamp(0.5 * (R.trace() - 1.0), -1.0, 1.0));
}

SegmentError error_between(const FramePair& first, const FramePair& last, double length_m,
                           double scale) {
  const Eigen::Matrix4d T_first_last_truth = relative_pose(first.T_world_truth, last.T_world_truth);
  Eigen::Matrix4d T_first_last_estimate =
      relative_pose(*first.T_world_estimate, *last.T_world_estimate);
  T_first_last_estimate.topRightCorner<3, 1>() *= scale;
  const Eigen::Matrix4d error = T_first_last_estimate.inverse() * T_first_last_truth;
  SegmentError segment;
  segment.first_frame = first.frame;
  segment.last_frame = last.frame;
  segment.length_m = length_m;
  segment.t_percent = error.topRightCorner<3, 1>().norm() / length_m * 100;
  segment.r_deg_per_100m = rad_to_deg(acos_of_trace(error.topLeftCorner<3, 3>())) / length_m * 100;
  return segment;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::round(value * 10) / 10);
  return text;
}

// Means of the segments that fall on the same key, by ascending key.
template <class Key>
std::map<long, SegmentGroup> grouped(const std::vector<SegmentError>& segments, Key&& key_of) {
  std::map<long, SegmentGroup> groups;
  for (const SegmentError& segment : segments) {
    SegmentGroup& group = groups[key_of(segment)];
    ++group.segments;
    group.t_percent += segment.t_percent;
    group.r_deg_per_100m += segment.r_deg_per_100m;
  }
  for (auto& [key, group] : groups) {
    group.t_percent /= group.segments;
    group.r_deg_per_100m /= group.segments;
  }
  return groups;
}

}  // namespace

void SegmentOptions::check() const {
  check_ranges(*this);
  require(!lengths_m.empty(), "lengths_m: empty list");
}

void visit(OptionVisitor& field, SegmentOptions& o) {
  field("lengths_m", o.lengths_m, "segment lengths of t_rel and r_rel [m]", {1e-3, 1e6});
  field("step", o.step, "frames between the starts of two segments", {1, 1e6});
  field("frame_rate_hz", o.frame_rate_hz,
        "frame rate for speeds, if the ground truth has no times [Hz]", {1e-3, 1e4});
  field("speed_bin_m_per_s", o.speed_bin_m_per_s,
        "width of an interval of the table per speed [m/s]", {1e-3, 1e3});
}

std::vector<SegmentGroup> group_by_length(const std::vector<SegmentError>& segments) {
  std::vector<SegmentGroup> rows;
  const auto micrometres = [](const SegmentError& s) { return std::lround(s.length_m * 1e6); };
  for (auto& [key, group] : grouped(segments, micrometres)) {
    group.from = group.to = static_cast<double>(key) * 1e-6;
    rows.push_back(group);
  }
  return rows;
}

std::vector<SegmentGroup> group_by_speed(const std::vector<SegmentError>& segments,
                                         double bin_m_per_s) {
  std::vector<SegmentGroup> rows;
  const auto bin = [&](const SegmentError& s) {
    return static_cast<long>(std::floor(s.speed_m_per_s / bin_m_per_s));
  };
  for (auto& [key, group] : grouped(segments, bin)) {
    group.from = static_cast<double>(key) * bin_m_per_s;
    group.to = static_cast<double>(key + 1) * bin_m_per_s;
    rows.push_back(group);
  }
  return rows;
}

SegmentResult kitti_segments(const std::vector<FramePair>& pairs, bool has_times,
                             const SegmentOptions& options, double scale) {
  options.check();
  SegmentResult result;
  const std::vector<double> distance_m = travelled_m(pairs);
  for (std::size_t i = 0; i < pairs.size(); i += static_cast<std::size_t>(options.step)) {
    for (const double length_m : options.lengths_m) {
      const auto end =
          std::upper_bound(distance_m.begin(), distance_m.end(), distance_m[i] + length_m);
      if (end == distance_m.end()) continue;
      const FramePair& first = pairs[i];
      const FramePair& last = pairs[static_cast<std::size_t>(end - distance_m.begin())];
      if (!first.T_world_estimate || !last.T_world_estimate) {
        ++result.skipped;
        continue;
      }
      SegmentError segment = error_between(first, last, length_m, scale);
      const double seconds = has_times ? static_cast<double>(last.stamp_ns - first.stamp_ns) * 1e-9
                                       : (last.frame - first.frame) / options.frame_rate_hz;
      segment.speed_m_per_s = length_m / seconds;
      result.segments.push_back(segment);
    }
  }
  if (result.segments.empty()) {
    const double shortest_m = *std::min_element(options.lengths_m.begin(), options.lengths_m.end());
    result.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        result.skipped > 0
            ? "all " + std::to_string(result.skipped) + " segments begin or end at a lost frame"
            : "the path of " + short_number(distance_m.empty() ? 0.0 : distance_m.back()) +
                  " m is too short for segments of " + short_number(shortest_m) + " m");
    return result;
  }
  for (const SegmentError& segment : result.segments) {
    result.t_rel_percent += segment.t_percent;
    result.r_rel_deg_per_100m += segment.r_deg_per_100m;
  }
  result.t_rel_percent /= static_cast<double>(result.segments.size());
  result.r_rel_deg_per_100m /= static_cast<double>(result.segments.size());
  result.by_length = group_by_length(result.segments);
  result.by_speed = group_by_speed(result.segments, options.speed_bin_m_per_s);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
