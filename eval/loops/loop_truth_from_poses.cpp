#include <fmt/format.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

/// The posed images of a set in the order of their first coordinate, so that few of them have to be
/// compared with a pose.
class PosedImages {
 public:
  explicit PosedImages(const Trajectory& poses) : poses_(poses) {
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (const auto& pose = poses.poses[i].T_world_body)
        images_.emplace_back(pose->translation().x(), static_cast<std::int64_t>(i));
    std::sort(images_.begin(), images_.end());
  }

  /// The images up to `last` with the same view as a pose, ascending.
  std::vector<FrameId> same_views(const Eigen::Isometry3d& pose, const SameView& same,
                                  FrameId last) const {
    std::vector<FrameId> found;
    const double x = pose.translation().x();
    const double reach_m = same.radius_m + 1e-9 * (same.radius_m + std::abs(x));  // beyond rounding
    auto image =
        std::lower_bound(images_.begin(), images_.end(), std::pair(x - reach_m, std::int64_t{-1}));
    for (; image != images_.end() && image->first <= x + reach_m; ++image)
      if (image->second <= last.value() &&
          same.holds(*poses_.poses[static_cast<std::size_t>(image->second)].T_world_body, pose))
        found.push_back(FrameId(image->second));
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  const Trajectory& poses_;
  std::vector<std::pair<double, std::int64_t>> images_;
};

}  // namespace

void RevisitOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RevisitOptions& o) {
  field.group("same", o.same, "criteria for two views of the same place");
  field("min_age", o.min_age, "minimum number of images from the older to the younger", {1, 1e9});
}

LoopTruth loop_truth_from_poses(const Trajectory& truth, const RevisitOptions& options) {
  options.check();
  LoopTruth result;
  result.min_age = options.min_age;
  result.protocol = LoopProtocol::kWithinDrive;
  const PosedImages images(truth);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto& T_world_query = truth.poses[i].T_world_body;
    if (!T_world_query) continue;
    const FrameId id(static_cast<std::int64_t>(i));
    LoopQuery query;
    query.last = FrameId(id.value() - options.min_age);
    query.matches = images.same_views(*T_world_query, options.same, query.last);
    result.queries.emplace(id, std::move(query));
  }
  return result;
}

LoopTruth loop_truth_between(const Trajectory& queries, const Trajectory& database,
                             const SameView& same) {
  same.check();
  SameView criteria = same;
  if (!queries.has_orientation || !database.has_orientation) criteria.heading_deg = 180;
  LoopTruth result;
  result.protocol = LoopProtocol::kQueryDatabase;
  const PosedImages images(database);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto& T_world_query = queries.poses[i].T_world_body;
    if (!T_world_query) continue;
    LoopQuery query;
    query.last = FrameId(static_cast<std::int64_t>(database.size()) - 1);
    query.matches = images.same_views(*T_world_query, criteria, query.last);
    result.queries.emplace(FrameId(static_cast<std::int64_t>(i)), std::move(query));
  }
  return result;
}

std::vector<Doubt> heading_doubts(const Trajectory& truth, const SameView& same) {
  if (same.heading_deg >= 180) return {};
  if (!truth.has_orientation)
    return {{DoubtKind::kHeadings,
             fmt::format("the headings of the true positions are unknown: distances alone decide, and "
                         "not {:g} deg (--heading 180 says so)",
                         same.heading_deg)}};
  const Eigen::Isometry3d* first = nullptr;
  for (const StampedPose& pose : truth.poses) {
    if (!pose.T_world_body) continue;
    if (!first) first = &*pose.T_world_body;
    // Rotations as their files have them: a camera that turned by less is no vehicle's.
    if (!pose.T_world_body->linear().isApprox(first->linear(), 1e-9)) return {};
  }
  if (!first || truth.posed() < 2) return {};
  return {{DoubtKind::kHeadings,
           fmt::format("all true poses have the same orientation, so that {:g} deg excludes no "
                       "candidate: the headings seem to be unknown",
                       same.heading_deg)}};
}

}  // namespace placegraph
