#include <placegraph/eval/loops/loop_truth_from_poses.h>

namespace placegraph {

void RevisitOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RevisitOptions& o) {
  field.group("same", o.same, "criteria for two views of the same place");
  field("min_age", o.min_age, "minimum number of images from the older to the younger", {1, 1e9});
}

LoopTruth loop_truth_from_poses(const Trajectory& truth, const RevisitOptions& options) {
  options.check();
  LoopTruth result;
  result.min_age = options.min_age;
  const auto count = static_cast<std::int64_t>(truth.size());
  const auto pose_at = [&](std::int64_t i) -> const std::optional<Eigen::Isometry3d>& {
    return truth.poses[static_cast<std::size_t>(i)].T_world_body;
  };
  for (std::int64_t i = 0; i < count; ++i) {
    const auto& T_world_query = pose_at(i);
    if (!T_world_query) continue;
    LoopQuery query;
    query.last = FrameId(i - options.min_age);
    for (std::int64_t j = 0; j <= query.last.value(); ++j) {
      const auto& T_world_match = pose_at(j);
      if (T_world_match && options.same.holds(*T_world_match, *T_world_query))
        query.matches.push_back(FrameId(j));
    }
    result.queries.emplace(FrameId(i), std::move(query));
  }
  return result;
}

}  // namespace placegraph
