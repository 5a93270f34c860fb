#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace placegraph {
namespace {

std::vector<std::int64_t> increasing_stamps(const Trajectory& trajectory, const char* which) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory.poses) {
    if (!stamps.empty() && pose.stamp_ns <= stamps.back())
      throw ArgumentError(std::string(which) + " trajectory: stamp " +
                          std::to_string(pose.stamp_ns) + " ns at index " +
                          std::to_string(stamps.size()) + " does not come after the one before");
    stamps.push_back(pose.stamp_ns);
  }
  return stamps;
}

/// Indices [begin, end) of each trajectory between two accepted pairs.
struct Gap {
  int begin_a, end_a, begin_b, end_b;
};

/// For each element of `from` in the gap, the index of the nearest of `to`; the earlier one of two
/// equally near.
std::vector<int> nearest(const std::vector<std::int64_t>& from, int begin, int end,
                         const std::vector<std::int64_t>& to, int to_begin, int to_end) {
  std::vector<int> result;
  result.reserve(end - begin);
  int j = to_begin;
  for (int i = begin; i < end; ++i) {
    while (j + 1 < to_end && std::abs(to[j + 1] - from[i]) < std::abs(to[j] - from[i])) ++j;
    result.push_back(j);
  }
  return result;
}

}  // namespace

std::size_t Trajectory::posed() const {
  return std::count_if(poses.begin(), poses.end(),
                       [](const StampedPose& pose) { return pose.T_world_body.has_value(); });
}

double Trajectory::path_length() const {
  double length = 0;
  const StampedPose* before = nullptr;
  for (const StampedPose& pose : poses) {
    if (!pose.T_world_body) continue;
    if (before)
      length += (pose.T_world_body->translation() - before->T_world_body->translation()).norm();
    before = &pose;
  }
  return length;
}

std::vector<std::pair<int, int>> associate_by_time(const Trajectory& a, const Trajectory& b,
                                                   const AssociationOptions& options) {
  require(options.max_difference_s >= 0 && options.max_difference_s < 1e9,
          "association: max_difference_s is not in [0, 1e9)");
  require(std::abs(options.offset_s) < 1e9, "association: offset_s is not within 1e9 s");
  const std::vector<std::int64_t> stamps_a = increasing_stamps(a, "first");
  std::vector<std::int64_t> stamps_b = increasing_stamps(b, "second");
  const std::int64_t offset_ns = std::llround(options.offset_s * 1e9);
  const std::int64_t limit_ns = std::llround(options.max_difference_s * 1e9);
  for (std::int64_t& stamp : stamps_b) stamp += offset_ns;

  // The closest pair of all, then the closest that crosses none chosen before, and so on: every
  // pair of mutual nearest neighbours belongs to it, so all of those are taken at once and the same
  // is done in the gaps between them.
  std::vector<std::pair<int, int>> pairs;
  std::vector<Gap> gaps = {
      {0, static_cast<int>(stamps_a.size()), 0, static_cast<int>(stamps_b.size())}};
  while (!gaps.empty()) {
    const Gap gap = gaps.back();
    gaps.pop_back();
    if (gap.begin_a >= gap.end_a || gap.begin_b >= gap.end_b) continue;
    const auto of_a = nearest(stamps_a, gap.begin_a, gap.end_a, stamps_b, gap.begin_b, gap.end_b);
    const auto of_b = nearest(stamps_b, gap.begin_b, gap.end_b, stamps_a, gap.begin_a, gap.end_a);
    int last_a = gap.begin_a, last_b = gap.begin_b;
    bool found = false;
    for (int i = gap.begin_a; i < gap.end_a; ++i) {
      const int j = of_a[i - gap.begin_a];
      if (of_b[j - gap.begin_b] != i || std::abs(stamps_a[i] - stamps_b[j]) > limit_ns) continue;
      pairs.emplace_back(i, j);
      gaps.push_back({last_a, i, last_b, j});
      last_a = i + 1;
      last_b = j + 1;
      found = true;
    }
    if (found) gaps.push_back({last_a, gap.end_a, last_b, gap.end_b});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::optional<SE3> interpolate(const Trajectory& trajectory, std::int64_t stamp_ns,
                               double max_gap_s) {
  const auto& poses = trajectory.poses;
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (after == poses.end() || !after->T_world_body) return std::nullopt;
  const SE3 T_world_after(*after->T_world_body);
  if (after->stamp_ns == stamp_ns) return T_world_after;
  if (after == poses.begin()) return std::nullopt;
  const auto before = after - 1;
  const double gap_ns = static_cast<double>(after->stamp_ns - before->stamp_ns);
  if (!before->T_world_body || gap_ns > max_gap_s * 1e9) return std::nullopt;
  const SE3 T_world_before(*before->T_world_body);
  const double share = static_cast<double>(stamp_ns - before->stamp_ns) / gap_ns;
  const SO3 R_before_after = T_world_before.rotation().inverse() * T_world_after.rotation();
  return SE3(T_world_before.rotation().plus(share * R_before_after.log()),
             (1 - share) * T_world_before.translation() + share * T_world_after.translation());
}

}  // namespace placegraph
