#include <placegraph/eval/loop_truth_from_poses.h>
#include <placegraph/eval/rpe.h>

#include <numbers>

namespace placegraph {

void RevisitOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RevisitOptions& o) {
  field("radius_m", o.radius_m, "largest distance of two views of one place [m]", {0, 1e6});
  field("heading_deg", o.heading_deg, "largest angle between them [deg]", {0, 180});
  field("min_age", o.min_age, "images from the older to the younger, at least", {1, 1e9});
}

LoopTruth loop_truth_from_poses(const Trajectory& truth, const RevisitOptions& options) {
  options.check();
  LoopTruth result;
  result.min_age = options.min_age;
  const double max_angle = options.heading_deg * std::numbers::pi / 180;
  const double max_squared = options.radius_m * options.radius_m;
  const auto count = static_cast<std::int64_t>(truth.size());
  const auto pose_at = [&](std::int64_t i) -> const std::optional<Eigen::Isometry3d>& {
    return truth.poses[static_cast<std::size_t>(i)].T_world_body;
  };
  for (std::int64_t i = 0; i < count; ++i) {
    const auto& T_world_query = pose_at(i);
    if (!T_world_query) continue;
    LoopQuery query;
    query.last = i - options.min_age;
    for (std::int64_t j = 0; j <= query.last; ++j) {
      const auto& T_world_match = pose_at(j);
      if (!T_world_match ||
          (T_world_query->translation() - T_world_match->translation()).squaredNorm() > max_squared)
        continue;
      const Eigen::Matrix3d R = T_world_match->linear().transpose() * T_world_query->linear();
      if (rotation_angle(R) <= max_angle) query.matches.push_back(j);
    }
    result.queries.emplace(i, std::move(query));
  }
  return result;
}

}  // namespace placegraph
