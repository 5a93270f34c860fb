#include <placegraph/eval/loops/loop_check.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace placegraph {
namespace {

const Eigen::Isometry3d* pose_of(const Trajectory& truth, FrameId frame) {
  if (frame.value() < 0 || frame.value() >= static_cast<std::int64_t>(truth.size())) return nullptr;
  const auto& T_world_cam = truth.poses[static_cast<std::size_t>(frame.value())].T_world_body;
  return T_world_cam ? &*T_world_cam : nullptr;
}

}  // namespace

void LoopCheckOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopCheckOptions& o) {
  field("max_translation_m", o.max_translation_m, "largest translation error of a correct loop [m]",
        {0, 1e6});
  field("max_rotation_deg", o.max_rotation_deg, "largest rotation error of a correct loop [deg]",
        {0, 180});
  field("min_frames_apart", o.min_frames_apart,
        "loops of nearer frames are neither correct nor wrong", {0, 1e9});
}

LoopCheck check_loops(const Trajectory& truth, const std::vector<LoopRecord>& loops,
                      const LoopCheckOptions& options) {
  options.check();
  LoopCheck result;
  for (const LoopRecord& loop : loops) {
    if (!loop.accepted()) continue;
    if (std::abs(loop.query_frame.value() - loop.match_frame.value()) < options.min_frames_apart) {
      ++result.too_near;
      continue;
    }
    const Eigen::Isometry3d* T_world_match = pose_of(truth, loop.match_frame);
    const Eigen::Isometry3d* T_world_query = pose_of(truth, loop.query_frame);
    if (!T_world_match || !T_world_query) {
      ++result.unjudged;
      continue;
    }
    const Eigen::Matrix4d error =
        relative_pose(*T_world_match, *T_world_query).inverse() * loop.T_match_query.matrix();
    CheckedLoop checked;
    checked.query_frame = loop.query_frame;
    checked.match_frame = loop.match_frame;
    checked.translation_error_m = error.topRightCorner<3, 1>().norm();
    checked.rotation_error_deg = rad_to_deg(rotation_angle(error.topLeftCorner<3, 3>()));
    checked.correct = checked.translation_error_m <= options.max_translation_m &&
                      checked.rotation_error_deg <= options.max_rotation_deg;
    ++(checked.correct ? result.correct : result.wrong);
    result.loops.push_back(checked);
  }
  return result;
}

}  // namespace placegraph
