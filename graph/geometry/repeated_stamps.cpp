#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/quantile.h>
#include <placegraph/graph/geometry/repeated_stamps.h>

namespace placegraph {
namespace {

// A stamp may be wrong by a row, where the motion is fastest; more is no motion. Chosen.
constexpr double kFastestShare = 0.95;
constexpr double kFarSteps = 3;

/// How far two poses are apart.
struct PoseDistance {
  double m = 0, rad = 0;
};

PoseDistance distance_of(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return {(a.translation() - b.translation()).norm(),
          Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()))};
}

/// The fastest motion from row to row, but for a few rows.
PoseDistance fastest_step(const std::vector<StampedPose>& poses) {
  std::vector<double> metres, radians;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!poses[i - 1].T_world_body || !poses[i].T_world_body) continue;
    const PoseDistance step = distance_of(*poses[i - 1].T_world_body, *poses[i].T_world_body);
    metres.push_back(step.m);
    radians.push_back(step.rad);
  }
  if (metres.empty()) return {};
  return {quantile_of(std::move(metres), kFastestShare),
          quantile_of(std::move(radians), kFastestShare)};
}

}  // namespace

std::string repeated_stamps_warning(const std::string& before_row,
                                    const std::vector<StampedPose>& kept,
                                    const std::vector<RepeatedStamp>& left_out) {
  if (left_out.empty()) return {};
  const PoseDistance fast = fastest_step(kept);
  PoseDistance most;
  std::size_t far = 0, first_far = 0;
  for (const RepeatedStamp& row : left_out) {
    const auto& T_kept = kept[row.kept].T_world_body;
    if (!T_kept || !row.T_world_body) continue;
    const PoseDistance apart = distance_of(*T_kept, *row.T_world_body);
    most = {std::max(most.m, apart.m), std::max(most.rad, apart.rad)};
    if (kept.size() < 2 || !(apart.m > kFarSteps * fast.m || apart.rad > kFarSteps * fast.rad))
      continue;
    if (far++ == 0) first_far = row.row;
  }
  std::string text = fmt::format(
      "{}{}: the stamp stands twice, and the first row of it is kept; {} left out, up to {:.3g} m "
      "and {:.2g} deg from the kept one",
      before_row, left_out.front().row,
      left_out.size() == 1 ? "1 row is" : fmt::format("{} such rows are", left_out.size()), most.m,
      rad_to_deg(most.rad));
  if (far > 0)
    text += fmt::format(
        "; {} (the first: {}) farther than motion explains, which is {:.3g} m and {:.2g} deg from "
        "row to row",
        far == 1 ? "one is" : fmt::format("{} are", far), first_far, fast.m, rad_to_deg(fast.rad));
  return text;
}

}  // namespace placegraph
